#pragma once

#include "app/document/leaving.h"
#include "app/document/session.h"
#include "app/files/save.h"

namespace mesher::app {

/// Closes the shown model, or quits; asks first if edits would be lost. To quit, shows one model
/// after another whose edits are not saved.
void request_leave(Session& session, Leaving leaving);

/// The answers to that question.
enum class LeaveAnswer { save, discard, cancel };
/// `save` opens the save dialog; once the file is written, the session leaves. Pre: a question is
/// open.
void answer_leave(Session& session, LeaveAnswer answer);

/// Call when a file was written: says so, and leaves if that is what it was written for.
void note_saved(Session& session, const Saved& saved);

/// Writes the requested file, on this thread. Throws OutputError.
void run_waiting_save(Session& session);

}  // namespace mesher::app

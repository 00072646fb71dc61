#pragma once

#include <string>

#include "app/document/document.h"

namespace mesher::app {

/// Returns the `mesher edit` command that reads the model from its file and makes the edits that
/// are done, quoted for a POSIX shell. It writes to the name that the save dialog suggests. Pre:
/// there is an edit, and the model has a source that can be read again.
std::string command_line(const Document& document);

}  // namespace mesher::app

#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "app/document/document.h"
#include "app/document/edit_task.h"
#include "app/edit/edit_words.h"

namespace mesher::app {

/// A kind of edit that can be written as text (EditWords). Every edit of the history can: its text
/// lists all of its rules, so that it gives the same model whatever the current rules are.
struct EditKind {
  const char* name;    ///< "simplify_to"
  const char* values;  ///< "`faces=N`, rules of simplification"
  const char* help;    ///< "simplify the model as it was opened"
  std::unique_ptr<EditTask> (*make)(EditWords& words, const Document& document);
};

std::span<const EditKind> edit_kinds();

/// Returns the edit that a text describes. Rules that the text does not list are those of the
/// document. Throws UsageError if there is no such edit or a value does not fit.
std::unique_ptr<EditTask> edit_from_text(std::string_view text, const Document& document);

}  // namespace mesher::app

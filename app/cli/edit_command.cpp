#include "app/cli/edit_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "app/cli/arguments.h"
#include "app/cli/batch.h"
#include "app/cli/view.h"
#include "app/document/json.h"
#include "app/document/shown.h"
#include "app/edit/edit_text.h"
#include "app/edit/edits.h"
#include "app/files/save.h"
#include "app/input/commands.h"
#include "engine/core/error.h"

namespace mesher::app {
namespace {

// Commands of the window do nothing here.
bool is_allowed(const Command& command) {
  return std::holds_alternative<void (*)(Document&)>(command.function);
}

std::vector<std::string> names_of_steps() {
  std::vector<std::string> names;
  for (const EditKind& kind : edit_kinds())
    names.emplace_back(kind.name);
  for (const Command& command : commands()) {
    if (is_allowed(command)) names.emplace_back(command.id);
  }
  return names;
}

void check_step(const std::string& text) {
  const EditWords words(text);
  const bool is_edit = std::ranges::count(edit_kinds(), words.name(), &EditKind::name) > 0;
  const Command* command = command_named(words.name());
  if (is_edit || (command != nullptr && is_allowed(*command))) return;
  if (command != nullptr) throw UsageError("--do: '" + words.name() + "' works in the window only");
  const std::string nearest = nearest_name(words.name(), names_of_steps());
  throw UsageError("--do: there is no command '" + words.name() + "'" +
                   (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
}

void run_step(Session& session, const std::string& text) {
  const EditWords words(text);
  const Command* command = command_named(words.name());
  if (command != nullptr && is_allowed(*command) && !words.has_values()) {
    run(session, *command);
  } else {
    request(session.document.edits, edit_from_text(text, session.document));
  }
  run_waiting_edits(session.document);
}

Json steps_json(const History& history) {
  Json json = Json::array();
  for (std::size_t i = 0; i < history.done_steps(); ++i)
    json.push_back({{"name", history.steps()[i].name}, {"edit", history.steps()[i].text}});
  return json;
}

}  // namespace

std::vector<std::string> split_script(const std::string& script) {
  std::vector<std::string> steps;
  std::istringstream parts(script);
  for (std::string part; std::getline(parts, part, ';');) {
    const std::size_t first = part.find_first_not_of(" \t\n");
    if (first == std::string::npos) continue;
    steps.push_back(part.substr(first, part.find_last_not_of(" \t\n") - first + 1));
  }
  return steps;
}

void run_edit(const InputOptions& input, const std::string& output, const std::string& script,
              const CommonOptions& common) {
  const std::vector<std::string> steps = split_script(script);
  if (steps.empty()) throw UsageError("--do: there is nothing to do");
  std::ranges::for_each(steps, check_step);
  check_output(output);
  Session session;
  InputOptions shown = input;
  shown.keeps_scene = true;  // as in the window, so that an edit gives the same there
  open_whole(session, shown, common);
  for (const std::string& step : steps) {
    run_step(session, step);
    const std::string& notice = session.document.notice;
    if (!common.quiet && !notice.empty()) say(fmt::format("{}: {}", step, notice));
  }
  if (shown_mesh(session.document).face_count() == 0)
    throw InputError(session.document.file.string(), 0, "has no faces to write");
  session.saving.waiting = output;
  SaveTask task = *begin_save(session.saving, session.document);
  task.flush = common.flush();
  const Saved saved = perform(task);
  if (!common.quiet) {
    say_losses(output, saved.losses);
    say_written(output, saved.vertices, saved.faces);
  }
  if (!common.json) return;
  print_json({{"input", session.document.file.string()},
              {"output", output},
              {"edits", steps_json(session.document.edits.history)},
              {"vertices", saved.vertices},
              {"faces", saved.faces},
              {"lost", saved.losses}});
}

}  // namespace mesher::app

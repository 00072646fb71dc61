#include <imgui.h>

#include <cctype>

#include "app/document/shown.h"
#include "app/files/browse.h"
#include "app/files/save.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "engine/core/text.h"
#include "engine/io/format.h"
#include "engine/io/pm_file.h"

namespace mesher::app {
namespace {

constexpr float kSaveWidthPoints = 720.0F;
// Of the list of formats, what they lose, and the button.
constexpr float kFormatPoints = 110.0F;

std::string list_of_names(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names)
    list += (list.empty() ? "" : ", ") + name;
  return list;
}

/// Returns a format as the list shows it: "STL (.stl), without creases".
std::string format_text(const Document& document, const std::string& extension) {
  const io::FormatInfo* format = io::format_of("x" + extension);
  if (format == nullptr) return "none";
  const std::string lost = list_of_names(always_lost(document, extension));
  return std::string(format->name) + " (" + format->extension + ")" +
         (lost.empty() ? "" : ", without " + lost);
}

void draw_formats(Saving& saving, const Document& document, const std::string& chosen) {
  label("format");
  if (ImGui::BeginCombo("##format", format_text(document, chosen).c_str())) {
    for (const std::string& extension : saved_extensions()) {
      if (ImGui::Selectable(format_text(document, extension).c_str(), extension == chosen))
        choose_format(saving, extension);
      note_widget(extension);
    }
    ImGui::EndCombo();
  }
  note_widget("format");
}

/// Finds the losses again if the model, its level or the format has changed. O(F) then.
const std::vector<std::string>& shown_losses(ShownLosses& shown, const Document& document,
                                             const std::filesystem::path& file,
                                             const std::string& extension) {
  const std::uint32_t faces = shown_mesh(document).face_count();
  const std::uint64_t revision = document.edits.revision;
  if (shown.opening != document.opening || shown.revision != revision || shown.faces != faces ||
      shown.extension != extension) {
    shown = {document.opening, revision, faces, extension, losses_of(document, file)};
  }
  return shown.losses;
}

void draw_losses(const std::vector<std::string>& losses) {
  if (losses.empty()) {
    faint_text("The file preserves everything.");
  } else {
    remark_text("Not preserved: " + list_of_names(losses));
  }
}

}  // namespace

void draw_save_dialog(Session& session, Ui& ui) {
  Saving& saving = session.saving;
  const Document& document = session.document;
  if (begin_dialog("Save the model", &saving.shows_dialog, kSaveWidthPoints)) {
    const auto shown = draw_browser(saving.browser, session, ui.save_list, kFormatPoints, ui);
    const std::filesystem::path file = typed_file(saving.browser);
    const io::FormatInfo* format = io::format_of(file);
    const std::string extension = format != nullptr ? format->extension : "";
    draw_formats(saving, document, extension);
    if (document.progressive.is_on())
      faint_text(io::has_pm_ending(file)
                     ? "All levels are written."
                     : "The shown level is written: " +
                           count_text(shown_mesh(document).face_count(), "face") + ".");
    if (format != nullptr) draw_losses(shown_losses(ui.losses, document, file, extension));
    const bool overwrites = !saving.asked.empty() && !saving.browser.problem.empty();
    if (wide_button(overwrites ? "Overwrite###save" : "Save###save", true, "Enter") || ui.submits)
      submit_save(saving, document, shown);
  }
  end_dialog(ui.areas);
}

}  // namespace mesher::app

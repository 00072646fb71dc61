#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>

#include "app/document/shown.h"
#include "app/edit/edits.h"
#include "app/edit/progressive_edits.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "app/ui/style.h"
#include "engine/core/text.h"

namespace mesher::app {
namespace {

std::string faces_text(std::uint32_t faces, std::uint32_t most) {
  return fmt::format("{} of {}", count_text(faces), count_text(most, "face"));
}

/// Draws the name of what the slider does at the left, and the numbers at the right.
void draw_line(const char* what, const std::string& numbers) {
  const float place = ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(numbers.c_str()).x;
  const bool has_room = ImGui::CalcTextSize(what).x + units(24.0F) < place;
  if (has_room) {
    ImGui::TextDisabled("%s", what);
    ImGui::SameLine(place);
  }
  ImGui::TextUnformatted(numbers.c_str());
}

/// Applies the level of the progressive mesh while the slider is dragged.
void draw_level_slider(ProgressiveView& view, bool is_compact) {
  auto position = static_cast<float>(view.position());
  const progressive::ProgressiveMesh& mesh = view.mesh();
  draw_line("progressive mesh", faces_text(mesh.mesh().face_count(), mesh.full_face_count()));
  if (!is_compact) {
    const bool is_playing = view.is_playing();
    if (ImGui::Button(is_playing ? "pause###play" : "play###play", {units(60.0F), 0.0F}))
      view.play(!is_playing);
    note_widget("play");
    tooltip("Space: play back and forth between the base and the full mesh.");
    ImGui::SameLine();
  }
  ImGui::SetNextItemWidth(-FLT_MIN);
  constexpr ImGuiSliderFlags kFlags =
      ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput | ImGuiSliderFlags_NoRoundToFormat;
  if (ImGui::SliderFloat("##level", &position, 0.0F, 1.0F, "", kFlags)) view.move_to(position);
  note_widget("slider");
  tooltip(
      "Level of detail, from the base to the full mesh, on a logarithmic scale.\n"
      "PageUp, PageDown: by a tenth. [ and ]: by one split. Home, End: base and full mesh.");
}

/// Simplifies when the slider is released. If the model has more faces than it was opened with, the
/// slider is at its right end.
void draw_face_slider(Document& document, Ui& ui) {
  const auto most = static_cast<int>(document.edits.opened_faces);
  const int fewest = std::min(document.statistics.is_closed() ? 4 : 1, most);
  const bool is_held =
      ui.slider_faces != 0 && ImGui::IsMouseDown(ImGuiMouseButton_Left) && ImGui::IsAnyItemActive();
  const std::uint32_t faces = document.statistics.faces;
  draw_line("detail", is_held ? faces_text(static_cast<std::uint32_t>(ui.slider_faces),
                                           static_cast<std::uint32_t>(most))
                      : faces <= document.edits.opened_faces
                          ? faces_text(faces, document.edits.opened_faces)
                          : count_text(faces, "face"));
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::BeginDisabled(faces == 0);
  ImGui::SliderInt("##faces", &ui.slider_faces, fewest, std::max(most, fewest + 1), "",
                   ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  ImGui::EndDisabled();
  note_widget("slider");
  tooltip(
      "Release to simplify the opened model to this number of faces. Drag to the right to restore "
      "detail, up to that of the opened model. Detail that a subdivision added is lost.");
  if (ImGui::IsItemDeactivatedAfterEdit()) {
    request_simplify_to(document, static_cast<std::uint32_t>(ui.slider_faces));
  } else if (!ImGui::IsItemActive() && ui.facts.job == nullptr && document.edits.waiting.empty()) {
    ui.slider_faces = std::min(static_cast<int>(faces), std::max(most, fewest + 1));
  }
}

}  // namespace

void draw_detail_bar(Document& document, Ui& ui) {
  if (!begin_part("detail", ui.layout.detail)) return;
  if (document.opening == 0) {
    faint_text("detail");
  } else if (document.progressive.is_on()) {
    draw_level_slider(document.progressive, ui.layout.width == Layout::Width::small);
  } else {
    draw_face_slider(document, ui);
  }
  end_part(ui.areas);
}

}  // namespace mesher::app

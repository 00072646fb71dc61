#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>

#include "app/document/meshes.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "app/ui/style.h"
#include "engine/core/text.h"

namespace mesher::app {
namespace {

constexpr std::size_t kMostLines = 10;
constexpr float kIndentPoints = 10.0F;
constexpr std::uint32_t kDeepestIndent = 6;  // beyond, names would have no room
constexpr float kCountPoints = 56.0F;

/// Makes the list again when the model has changed.
void update(const Document& document, SceneList& list) {
  const std::uint64_t generation = document.model_generation;
  const std::uint64_t revision = document.edits.revision;
  if (!list.faces.empty() && list.generation == generation && list.revision == revision) return;
  const scene::Scene& scene = *document.model.scene;
  list = {generation, revision, face_counts(document.model.attributes, scene.meshes.size()),
          nodes_with_faces(scene)};
}

std::string node_name(const scene::Scene& scene, std::uint32_t index) {
  const scene::Node& node = scene.nodes[index];
  if (!node.name.empty()) return node.name;
  return node.mesh == kNone ? fmt::format("node {}", index) : mesh_name(scene, node.mesh);
}

bool has_faces(const scene::Scene& scene, const scene::Node& node) {
  return node.mesh != kNone && scene.meshes[node.mesh].has_faces;
}

std::string help_of(const scene::Scene& scene, const scene::Node& node, std::uint32_t faces) {
  if (!has_faces(scene, node)) return "A node without triangles.";
  const std::size_t places = scene.meshes[node.mesh].placements.size();
  std::string help = fmt::format("{}: {}", mesh_name(scene, node.mesh), count_text(faces, "face"));
  if (places > 1) help += fmt::format(", shown {} times", count_text(std::int64_t(places)));
  return help + ". Click: edits apply to this mesh only.";
}

void draw_name(Document& document, const scene::Node& node, const std::string& name,
               std::uint32_t faces) {
  const scene::Scene& scene = *document.model.scene;
  const bool is_mesh = has_faces(scene, node);
  const float end = content_end();
  const float count_start = is_mesh ? end - units(kCountPoints) : end;
  const bool is_chosen = is_mesh && document.chosen_mesh == node.mesh;
  if (ImGui::Selectable("##node", is_chosen,
                        is_mesh ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled)) {
    choose_mesh(document, is_chosen ? kNone : node.mesh);
  }
  note_widget("mesh " + name);
  ellipsis_text(name, count_start, is_mesh);
  tooltip(help_of(scene, node, faces).c_str());
  if (!is_mesh) return;
  ImGui::SameLine(count_start - ImGui::GetWindowPos().x);
  ImGui::TextUnformatted(count_text(faces).c_str());
}

void draw_node(Document& document, std::uint32_t index, const std::vector<std::uint32_t>& faces) {
  const scene::Scene& scene = *document.model.scene;
  const scene::Node& node = scene.nodes[index];
  const std::string name = node_name(scene, index);
  ImGui::PushID(static_cast<int>(index));
  bool is_shown = index >= document.hidden.size() || !document.hidden[index];
  if (ImGui::Checkbox("##shown", &is_shown)) show_node(document, index, is_shown);
  note_widget("show " + name);
  tooltip("Show or hide, with everything below.");
  ImGui::SameLine(0.0F, units(4.0F) + units(kIndentPoints) *
                                          static_cast<float>(std::min(node.depth, kDeepestIndent)));
  draw_name(document, node, name, node.mesh == kNone ? 0 : faces[node.mesh]);
  ImGui::PopID();
}

void draw_list(Document& document, const SceneList& list) {
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {units(1.0F), units(1.0F)});
  const float line = ImGui::GetFrameHeightWithSpacing();
  const std::size_t lines = std::min(list.nodes.size(), kMostLines);
  ImGui::BeginChild("nodes", {0.0F, static_cast<float>(lines) * line});
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(list.nodes.size()), line);
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
      draw_node(document, list.nodes[static_cast<std::size_t>(i)], list.faces);
  }
  ImGui::EndChild();
  ImGui::PopStyleVar();
}

const char* animation_name(const scene::Scene& scene, std::uint32_t index) {
  if (index == kNone) return "at rest";
  const std::string& name = scene.animations[index].name;
  return name.empty() ? "without a name" : name.c_str();
}

void draw_animation_choice(Document& document) {
  const scene::Scene& scene = *document.model.scene;
  const std::uint32_t current = document.playback.animation;
  note_text(animation_name(scene, current));
  ImGui::SetNextItemWidth(-FLT_MIN);
  const bool is_open = ImGui::BeginCombo("##animation", animation_name(scene, current));
  note_widget("animation");
  tooltip("The animation that is shown. Edits and files keep the meshes as they are at rest.");
  if (!is_open) return;
  const auto count = static_cast<std::uint32_t>(scene.animations.size());
  for (std::uint32_t i = 0; i <= count; ++i) {
    const std::uint32_t index = i == 0 ? kNone : i - 1;
    note_text(animation_name(scene, index));
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(animation_name(scene, index), index == current))
      choose_animation(document, index);
    ImGui::PopID();
  }
  ImGui::EndCombo();
}

void draw_player(Document& document) {
  if (!has_animations(document)) return;
  heading("Animation");
  draw_animation_choice(document);
  Playback& playback = document.playback;
  if (ImGui::Button(playback.is_playing ? "pause###play" : "play###play", {units(60.0F), 0.0F}))
    play_animation(document);
  note_widget("play animation");
  tooltip("Space: play or pause.");
  if (!playback.is_on()) return;
  ImGui::SameLine();
  auto time = static_cast<float>(playback.time_s);
  const auto duration =
      static_cast<float>(document.model.scene->animations[playback.animation].duration_s);
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (ImGui::SliderFloat("##time", &time, 0.0F, duration, "%.2f s", ImGuiSliderFlags_AlwaysClamp)) {
    playback.time_s = double(time);
    playback.is_playing = false;
  }
  note_widget("time");
  tooltip("The moment of the animation that is shown.");
}

}  // namespace

void draw_scene(Document& document, Ui& ui) {
  const scene::Scene* const scene = document.model.scene.get();
  if (scene == nullptr || scene->order.empty()) return;
  heading("Scene");
  update(document, ui.scene_list);
  draw_list(document, ui.scene_list);
  const std::string target =
      document.chosen_mesh == kNone
          ? "Edits apply to all meshes."
          : "Edits apply to " + mesh_name(*scene, document.chosen_mesh) + ".";
  faint_text(target);
  const char* const reason = need_chosen(document);
  if (half_button("isolate", reason == nullptr,
                  reason == nullptr ? "Shift+I: show the chosen mesh only."
                                    : "Choose a mesh in the list first.")) {
    isolate_chosen(document);
  }
  ImGui::SameLine();
  if (half_button("show all", need_hidden(document) == nullptr, "Shift+V: show all nodes."))
    show_all_nodes(document);
  draw_player(document);
}

}  // namespace mesher::app

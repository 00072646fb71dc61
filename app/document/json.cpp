#include "app/document/json.h"

#include "app/document/shown.h"

namespace mesher::app {
namespace {

Json to_json(const glm::dvec3& v) {
  return Json::array({v.x, v.y, v.z});
}

Json to_json(const render::Camera& camera) {
  return {{"pivot", to_json(camera.pivot())},
          {"distance", camera.distance()},
          {"yaw_rad", camera.yaw_rad()},
          {"pitch_rad", camera.pitch_rad()},
          {"orthographic", camera.is_orthographic()}};
}

Json to_json(const SimplifySettings& settings) {
  Json json = options_json(simplify::kSimplifyRules, settings.rules);
  json.update(options_json(kSimplifyLimits, settings));
  return json;
}

Json last_subdivision(const Edits& edits) {
  if (!edits.last_subdivision) return {};
  const SubdivideOutcome& last = *edits.last_subdivision;
  return {{"level", last.level}, {"faces", last.faces}, {"seconds", last.seconds}};
}

/// JSON has no infinity.
Json sharpness_json(float sharpness) {
  return sharpness < kInfinitelySharp ? Json(sharpness) : Json("inf");
}

Json to_json(const CreaseMode& creases, const SelectedSharpness& sharpness) {
  const bool is_one = sharpness.edges > 0 && !sharpness.is_mixed();
  return {{"mode", creases.is_on},
          {"selected", creases.selected.size()},
          {"sharpness", is_one ? sharpness_json(sharpness.least) : Json()},
          {"hovered", creases.hovered.is_valid() ? Json(creases.hovered.index()) : Json()},
          {"tag_angle_deg", creases.tag_angle_deg}};
}

/// Null if nothing was pruned.
Json pruned_json(const SimplifyOutcome& outcome) {
  const simplify::SimplifyReport& r = outcome.report;
  if (r.pruned_parts == 0) return {};
  return {{"parts", r.pruned_parts},
          {"faces", r.pruned_faces},
          {"largest", r.largest_pruned},
          {"largest_percent", outcome.percent(r.largest_pruned)},
          {"unpruned_error", r.error_unpruned},
          {"unpruned_error_percent", outcome.percent(r.error_unpruned)}};
}

Json to_json(const ProgressiveView& view) {
  const progressive::ProgressiveMesh* mesh = view.has_mesh() ? &view.mesh() : nullptr;
  const auto if_any = [mesh](auto value) { return mesh != nullptr ? Json(value()) : Json(); };
  Json json{{"on", view.is_on()}};
  json.update(options_json(kProgressiveOptions, view.settings()));
  if (view.settings().base_faces == 0) json["base_faces"] = nullptr;  // chosen by size and error
  json.update({
      {"arriving", view.is_arriving()},
      {"ready", view.has_geomorph()},
      {"playing", view.is_playing()},
      {"position", if_any([&] { return view.position(); })},
      {"time", if_any([&] { return view.time(); })},
      {"level", if_any([&] { return mesh->level(); })},
      {"splits", if_any([&] { return mesh->split_count(); })},
      {"vertices", if_any([&] { return mesh->mesh().vertex_count(); })},
      {"faces", if_any([&] { return mesh->mesh().face_count(); })},
  });
  return json;
}

Json tab_names(const Session& session) {
  Json names = Json::array();
  for (std::size_t i = 0; i < tab_count(session); ++i)
    names.push_back(document_of(session, i).model.name);
  return names;
}

/// The open question, or null.
Json question_json(const Session& session) {
  if (session.unsaved) return "unsaved";
  return session.lost.empty() ? Json() : Json("lost");
}

}  // namespace

Json to_json(const Statistics& s) {
  Json json = Json::object();
  for (const Count& count : kCounts)
    json[count.key] = count.of(s);
  json.update({{"closed", s.is_closed()},
               {"area", s.area},
               {"volume", s.volume},
               {"diagonal", s.box.diagonal()}});
  if (s.box.is_empty()) {
    json["box"] = nullptr;
  } else {
    json["box"] = {{"min", to_json(glm::dvec3(s.box.min))},
                   {"max", to_json(glm::dvec3(s.box.max))}};
  }
  return json;
}

Json to_json(const BuildReport& report) {
  Json json = Json::object();
  for (std::size_t i = 0; i < kRepairs.size(); ++i) {
    const auto repair = static_cast<Repair>(i);
    json[std::string(key(repair))] = report[repair];
  }
  return json;
}

Json to_json(const FileContents& contents) {
  Json json = Json::object();
  for (std::size_t i = 0; i < kContents.size(); ++i) {
    const auto kind = static_cast<Content>(i);
    if (contents[kind] == 0) continue;
    json[std::string(key(kind))] = {{"count", contents[kind]}, {"names", contents.names(kind)}};
  }
  return json;
}

Json to_json(const Model& model, const Statistics& statistics, const std::filesystem::path& file) {
  Json figures = to_json(statistics);
  if (!statistics.box.is_empty()) {
    figures["box"] = {{"min", to_json(model.origin + glm::dvec3(statistics.box.min))},
                      {"max", to_json(model.origin + glm::dvec3(statistics.box.max))}};
  }
  Json json{{"file", file.string()},
            {"name", model.name},
            {"origin", to_json(model.origin)},
            {"statistics", std::move(figures)},
            {"contents", to_json(model.contents)},
            {"repairs", to_json(model.report)}};
  if (!model.contents.warnings().empty()) json["warnings"] = model.contents.warnings();
  return json;
}

Json to_json(const io::PmSummary& s) {
  const bool is_complete = s.damage.empty();
  Json json{{"mode", s.coordinate_bits == 0 ? "lossless" : "quantized"},
            {"coordinate_bits", s.coordinate_bits > 0 ? Json(s.coordinate_bits) : Json()},
            {"base_vertices", s.base_vertices},
            {"base_faces", s.base_faces},
            {"splits", s.splits},
            {"announced_splits", s.announced_splits},
            {"bytes", s.bytes},
            {"bytes_per_vertex", s.bytes_per_vertex()},
            {"indexed_bytes", s.indexed_bytes()},
            {"complete", is_complete},
            {"damage", is_complete ? Json() : Json(s.damage)}};
  if (s.attribute_bytes > 0) json["attribute_bytes"] = s.attribute_bytes;
  return json;
}

Json to_json(const analysis::SurfaceDistance& distance) {
  const auto figures = [&](const analysis::OneSidedDistance& side) {
    return Json{{"rms", side.rms},
                {"mean", side.mean},
                {"max", side.max},
                {"rms_percent", distance.percent(side.rms)},
                {"mean_percent", distance.percent(side.mean)},
                {"max_percent", distance.percent(side.max)}};
  };
  return {{"diagonal", distance.diagonal},
          {"two_sided", figures(distance.two_sided())},
          {"forward", figures(distance.forward)},
          {"backward", figures(distance.backward)}};
}

Json to_json(const analysis::SurfaceDistance& distance,
             const analysis::DistanceInterval& certified) {
  Json json = to_json(distance);
  json["certified_max"] = {{"lower", certified.lower},
                           {"upper", certified.upper},
                           {"lower_percent", distance.percent(certified.lower)},
                           {"upper_percent", distance.percent(certified.upper)}};
  return json;
}

Json to_json(const SimplifyOutcome& outcome) {
  const simplify::SimplifyReport& r = outcome.report;
  Json rejected = Json::object();
  for (std::size_t i = 0; i < simplify::kRejections.size(); ++i) {
    const auto cause = static_cast<simplify::Rejection>(i);
    rejected[std::string(key(cause))] = r[cause];
  }
  const auto if_any = [](bool is_there, double value) { return is_there ? Json(value) : Json(); };
  const bool is_measured = r.measured_error >= 0.0;
  return {{"asked_faces", r.faces_asked > 0 ? Json(r.faces_asked) : Json()},
          {"faces_before", r.faces_before},
          {"faces_reached", r.faces_reached},
          {"vertices_before", r.vertices_before},
          {"vertices_reached", r.vertices_reached},
          {"stop_reason", key(r.reason)},
          {"rejected", std::move(rejected)},
          {"collapses", r.collapses},
          {"estimated_error", r.estimated_error},
          {"estimated_error_percent", outcome.percent(r.estimated_error)},
          {"far_from_input", outcome.is_far()},
          {"measured_error", if_any(is_measured, r.measured_error)},
          {"measured_error_percent", if_any(is_measured, outcome.percent(r.measured_error))},
          {"certified_bound", if_any(r.certified_bound >= 0.0, r.certified_bound)},
          {"certified_bound_percent",
           if_any(r.certified_bound >= 0.0, outcome.percent(r.certified_bound))},
          {"pruned", pruned_json(outcome)},
          {"seconds",
           {{"prepare", r.seconds.prepare},
            {"collapse", r.seconds.collapse},
            {"finish", r.seconds.finish},
            {"measure", r.seconds.measure},
            {"total", r.seconds.total()}}},
          {"crosses_seams", outcome.crosses_seams}};
}

Json to_json(const simplify::ThinnedCards& cards) {
  if (cards.cards == 0) return {};
  return {{"count", cards.cards}, {"removed", cards.removed}, {"enlarged_by", cards.enlarged}};
}

Json to_json(const Session& session) {
  const Edits& edits = session.document.edits;
  Json json{
      {"file", session.document.file.string()},
      {"vertices", session.document.statistics.vertices},
      {"faces", session.document.statistics.faces},
      {"crease_edges", session.document.statistics.crease_edges},
      {"opened_faces", edits.opened_faces},
      {"unsaved", has_unsaved_edits(session.document)},
      {"undo_depth", edits.history.undo_depth()},
      {"redo_depth", edits.history.redo_depth()},
      {"simplify", to_json(session.document.simplify)},
      {"last_simplification", edits.last ? to_json(*edits.last) : Json()},
      {"creases", to_json(session.document.creases, selected_sharpness(session.document.model.mesh,
                                                                       session.document.creases))},
      {"subdivide", options_json(subdivide::kSubdivideRules, session.document.subdivide)},
      {"subdivision_level", shown_level(session.document.edits)},
      {"last_subdivision", last_subdivision(edits)},
      {"progressive", to_json(session.document.progressive)}};
  json.update(options_json(render::kRenderOptions, session.view.settings));
  json.update({{"camera", to_json(session.view.camera)},
               {"window", {session.view.window.x, session.view.window.y}},
               {"model_rectangle",
                {session.view.corner().x, session.view.corner().y, session.view.size().x,
                 session.view.size().y}},
               {"picture_finished", session.view.is_finished},
               {"tool", text_of(session.tool).key},
               {"info", session.shows_info},
               {"palette", session.shows_palette},
               {"help", session.shows_help},
               {"question", question_json(session)},
               {"open_dialog", session.open_dialog.is_shown},
               {"open_problem", session.open_dialog.browser.problem},
               {"start", session.shows_start},
               {"tabs", tab_names(session)},
               {"tab", shown_tab(session)},
               {"save_dialog", session.saving.shows_dialog},
               {"picture_dialog", session.picture.is_shown},
               {"error", session.document.error},
               {"notice", session.document.notice}});
  return json;
}

std::string to_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace mesher::app

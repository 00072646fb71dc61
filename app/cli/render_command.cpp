#include "app/cli/render_command.h"

#include "app/cli/batch.h"
#include "app/cli/progress_line.h"
#include "app/document/json.h"
#include "app/document/progressive_view.h"
#include "app/files/paths.h"
#include "app/files/picture.h"
#include "app/files/turntable.h"
#include "app/viewer/scripted_session.h"
#include "engine/core/error.h"
#include "engine/io/format.h"
#include "engine/io/image_decode.h"
#include "engine/io/pm_file.h"
#include "engine/progressive/attribute_morph.h"
#include "engine/progressive/base.h"
#include "engine/progressive/build.h"
#include "engine/progressive/detail_range.h"
#include "engine/progressive/geomorph.h"
#include "engine/simplify/seams.h"

namespace mesher::app {
namespace {

/// Times of building the progressive mesh, unless it was read, and of its geomorphs.
constexpr double kMakeDetailWeights[] = {0.65, 0.35};
constexpr double kReadDetailWeights[] = {0.0, 1.0};

/// A model in all its levels.
struct Detail {
  progressive::ProgressiveMesh mesh;
  progressive::Geomorph geomorph;
  progressive::ProgressiveAttributes attributes;
  progressive::AttributeMorph attribute_morph;
  DetailMoment moment;
};

progressive::Progressive progressive_of(const LoadedModel& loaded, Progress* progress) {
  simplify::SimplifyOptions options{.progress = progress};
  progressive::choose_base(options, loaded.model.mesh.face_count(),
                           loaded.statistics.box.diagonal(),
                           simplify::may_have_lines(loaded.model.attributes));
  return progressive::make_progressive(loaded.model.mesh, loaded.model.attributes, options);
}

Size size_of(const LookOptions& look) {
  return parse_size(look.size.empty() ? "800x600" : look.size);
}

void show(Session& session, LoadedModel&& loaded, const LookOptions& look) {
  const Size size = size_of(look);
  session.view.window = {size.width, size.height};
  show_model(session, std::move(loaded.model), loaded.statistics, loaded.file);
  apply_look(session.view, session.document.statistics.box, look);
}

/// Opens the model for a picture at `lod`. The camera is framed on the full model.
Detail open_detail(Session& session, LoadedLevels&& opened, double lod, const LookOptions& look,
                   const CommonOptions& common) {
  Detail detail;
  ProgressLine line(!common.quiet);
  Stages stages(line.progress(), opened.levels ? kReadDetailWeights : kMakeDetailWeights);
  stages.next();
  if (opened.levels) {
    detail.mesh = std::move(*opened.levels);
    detail.attributes = std::move(opened.attributes);
  } else {
    progressive::Progressive made = progressive_of(opened.loaded, line.progress());
    detail.mesh = std::move(made.mesh);
    detail.attributes = std::move(made.attributes);
  }
  show(session, std::move(opened.loaded), look);
  detail.moment = detail_moment(lod, detail.mesh.base_vertex_count(), detail.mesh.split_count());
  detail.mesh.go_to(detail.moment.level);
  stages.next("preparing geomorphs");
  detail.geomorph = progressive::Geomorph(detail.mesh, line.progress());
  if (!detail.attributes.is_empty()) {
    detail.attribute_morph = progressive::AttributeMorph(detail.attributes, line.progress());
    detail.attributes.go_to(detail.moment.level);
    detail.attribute_morph.follow(detail.attributes);
  }
  session.view.settings.geomorph = detail.moment.growth;
  session.view.settings.colors_by_split_order = look.split_colors;
  session.view.settings.first_split_vertex = detail.mesh.base_vertex_count();
  session.document.statistics = statistics(detail.mesh.mesh());
  return detail;
}

/// Refuses what cannot be drawn or written, before the work starts.
void check(const std::string& output, const LookOptions& look, const PictureArguments& picture) {
  const Size size = size_of(look);
  const VkExtent2D window{size.width, size.height};
  const std::string objection =
      picture.turntable ? turntable_objection(output, window, picture.options, picture.turn)
                        : picture_objection(output, window, picture.options);
  if (!objection.empty()) throw UsageError(objection);
  if (picture.turntable) return check_turntable_files(output, picture.turn);
  io::AtomicFile::check(output);
}

void write(const PictureScene& scene, const std::string& output, const PictureArguments& picture,
           const CommonOptions& common) {
  ProgressLine line(!common.quiet);
  if (picture.turntable) {
    write_turntable(scene, picture.options, picture.turn, output, line.progress(), common.flush());
  } else {
    write_picture(scene, picture.options, output, line.progress(), common.flush());
  }
}

void print_report(const Session& session, const std::string& output,
                  const PictureArguments& picture, const std::optional<io::PmSummary>& pm,
                  const Json& detail) {
  Json json = to_json(session);
  json["output"] = output;
  if (!detail.is_null()) json["detail"] = detail;
  json["picture"] = options_json(kPictureOptions, picture.options);
  const auto side = [&](double window) {
    return picture.options.scale * static_cast<std::uint32_t>(window);
  };
  json["picture"]["size"] = {side(session.view.window.x), side(session.view.window.y)};
  if (picture.turntable) json["turntable"] = options_json(kTurntableOptions, picture.turn);
  add_pm(json, pm);
  print_json(json);
}

void write_detail(Detail& detail, const Session& session, const std::string& output,
                  const LookOptions& look, const PictureArguments& picture,
                  const CommonOptions& common) {
  gpu::Instance instance({.extensions = {}, .validation = look.validation});
  gpu::Device device(instance, {.select = look.device});
  const progressive::Geomorph& geomorph = detail.geomorph;
  render::GpuMesh mesh(device);
  std::vector<std::string> problems;
  const std::shared_ptr<const Materials>& materials = session.document.model.materials;
  const auto decode = [&](std::span<const ImageRequest> images, const TakeImage& take) {
    io::decode_images(*materials, images, take, problems);
  };
  mesh.apply(
      detail.mesh.mesh(), session.view.settings,
      {.corner_normals = {},
       .vertex_normals = geomorph.normals(),
       .morph = {.heads = geomorph.heads(), .splits = geomorph.splits()},
       .appearance = {
           .attributes = detail.attributes.is_empty() ? nullptr : &detail.attributes.arrays(),
           .materials = materials,
           .decode = decode,
           .morph = detail.attribute_morph.view()}});
  if (!common.quiet) {
    for (const std::string& problem : problems)
      say(problem);
  }
  render::Renderer renderer(device);
  const VkExtent2D window{static_cast<std::uint32_t>(session.view.window.x),
                          static_cast<std::uint32_t>(session.view.window.y)};
  const LegendFacts facts{
      .crease_edges = session.document.statistics.crease_edges,
      .base_vertices = detail.mesh.base_vertex_count(),
      .all_vertices = detail.mesh.base_vertex_count() + detail.mesh.split_count()};
  write({.device = device,
         .renderer = renderer,
         .mesh = mesh,
         .camera = session.view.camera,
         .settings = session.view.settings,
         .box = session.document.statistics.box,
         .legend = legend_of_picture(session.view.settings, facts, window, picture.options),
         .window = window},
        output, picture, common);
  if (instance.messages().count() > 0) {
    throw DeviceError("validation: " + instance.messages().list().front());
  }
}

void draw_moment(LoadedLevels&& opened, double lod, const std::string& output,
                 const LookOptions& look, const PictureArguments& picture,
                 const CommonOptions& common) {
  Session session;
  const std::optional<io::PmSummary> pm = opened.loaded.pm;
  Detail detail = open_detail(session, std::move(opened), lod, look, common);
  write_detail(detail, session, output, look, picture, common);
  if (!common.json) return;
  print_report(session, output, picture, pm,
               {{"lod", lod},
                {"level", detail.moment.level},
                {"splits", detail.mesh.split_count()},
                {"time", detail.moment.time},
                {"window", detail.moment.window}});
}

void draw(LoadedModel&& loaded, const std::string& output, const LookOptions& look,
          const PictureArguments& picture, const CommonOptions& common) {
  Session session;
  const std::optional<io::PmSummary> pm = loaded.pm;
  show(session, std::move(loaded), look);
  ScriptedSession script(session, {.device = look.device, .validation = look.validation});
  // A turntable shows each part from near and from far.
  const PictureOptions& options = picture.options;
  PictureScene scene = script.scene(picture.turntable ? 0 : options.scale * options.supersample);
  for (const std::string& line : script.not_drawn())
    say(line);
  scene.legend = legend_of_picture(scene.settings, legend_facts(session.document), scene.window,
                                   picture.options);
  write(scene, output, picture, common);
  script.expect_no_messages();
  if (common.json) print_report(session, output, picture, pm, {});
}

/// Refuses a model whose picture would be empty.
void check_faces(const LoadedModel& loaded) {
  if (loaded.model.mesh.face_count() == 0) {
    throw InputError(loaded.file.string(), 0, "has no faces to draw");
  }
}

/// Reduces the number of faces: by the level of a progressive mesh, or by simplification.
void reduce(LoadedLevels& opened, const DetailArguments& detail, const CommonOptions& common) {
  LoadedModel& loaded = opened.loaded;
  if (!opened.levels) {
    simplify_model(loaded, {.target_faces = *detail.faces}, common);
    return;
  }
  opened.levels->go_to(level_for(detail, *opened.levels));
  loaded.model.mesh = std::move(opened.levels->mesh());
  loaded.statistics = statistics(loaded.model.mesh);
}

}  // namespace

DetailMoment detail_moment(double lod, std::uint32_t base_vertices, std::uint32_t splits) {
  const progressive::DetailRange range{.base_vertices = double(base_vertices),
                                       .splits = splits,
                                       .geomorph_range = ProgressiveSettings{}.geomorph_range};
  const double time = lod * range.end();
  return {.time = time,
          .window = range.growing(time),
          .level = range.level(time),
          .growth = range.growth(time)};
}

void run_render(const InputOptions& input, const std::string& output, const LookOptions& look,
                const PictureArguments& picture, const DetailArguments& detail,
                const CommonOptions& common) {
  // Reject bad arguments before the work starts.
  if (!look.camera.empty()) parse_camera(look.camera);
  check_pose(input);
  check(output, look, picture);
  if (!detail.faces && !detail.lod) {
    // As in the window, with all attributes. A pose is taken from the file, not from the scene.
    InputOptions shown = input;
    shown.keeps_scene = !input.animation;
    LoadedModel loaded = load(shown, common);
    check_faces(loaded);
    return draw(std::move(loaded), output, look, picture, common);
  }
  LoadedLevels opened = load_levels(input, common);
  check_faces(opened.loaded);
  if (detail.lod) return draw_moment(std::move(opened), *detail.lod, output, look, picture, common);
  reduce(opened, detail, common);
  draw(std::move(opened.loaded), output, look, picture, common);
}

}  // namespace mesher::app

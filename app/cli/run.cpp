#include "app/cli/run.h"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <limits>
#include <new>

#include "app/cli/arguments.h"
#include "app/cli/batch.h"
#include "app/cli/lods_command.h"
#include "app/cli/progressive_command.h"
#include "app/cli/render_command.h"
#include "app/cli/simplify_command.h"
#include "app/cli/subdivide_command.h"
#include "app/cli/view.h"
#include "engine/analysis/distance.h"
#include "engine/core/error.h"
#include "engine/core/parallel.h"

namespace mesher::app {
namespace {

constexpr const char* kDefaultModel = "bunny.obj";

// CLI::Range lets NaN through.
std::string check_angle(const std::string& text) {
  const double value = std::strtod(text.c_str(), nullptr);
  return value >= 0.0 && value <= 180.0 ? "" : "'" + text + "' is not an angle from 0 to 180";
}

std::string check_share(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && value >= 0.0 && value <= 1.0
             ? ""
             : "'" + text + "' is not in 0 to 1";
}

/// The command line's grammar, and what it was filled with.
class CommandLine {
 public:
  CommandLine() {
    app_.require_subcommand(1);
    app_.set_version_flag("--version", "mesher " MESHER_VERSION);
    app_.footer(
        "Without a command, `view` is meant: mesher bunny.obj\n"
        "One dash will do: mesher -input bunny.obj -size 500 -gouraud\n"
        "A model named without a folder is also looked for in assets/.\n"
        "Exit codes: 0 done; 1 usage; 2 input cannot be used; 3 the machine lacks something;\n"
        "4 output cannot be written.");
    add_view();
    add_render();
    add_info();
    add_convert();
    add_simplify();
    add_subdivide();
    add_progressive();
    add_extract();
    add_lods();
    add_compare();
  }

  void parse(int argc, const char* const* argv) {
    std::vector<std::string> commands;
    std::vector<std::string> long_options;
    for (const CLI::App* command : app_.get_subcommands({})) {
      commands.push_back(command->get_name());
      for (const CLI::Option* option : command->get_options()) {
        const auto& names = option->get_lnames();
        long_options.insert(long_options.end(), names.begin(), names.end());
      }
    }
    std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
    arguments = normalized_arguments(std::move(arguments), commands, long_options);
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
    app_.parse(std::move(arguments));
  }

  void run() {
    const ThreadLimit limit(common_.threads);
    action_();
  }

  int explain(const CLI::ParseError& error) const {
    const bool is_help = app_.exit(error, std::cout, std::cerr) == 0;
    return static_cast<int>(is_help ? ExitCode::done : ExitCode::usage);
  }

 private:
  CLI::App* add_command(const char* name, const char* what, std::function<void()> action) {
    CLI::App* command = app_.add_subcommand(name, what);
    command->add_flag("--json", common_.json, "one JSON object on stdout");
    command->add_flag("--quiet", common_.quiet, "no words on stderr but errors");
    command->add_option("--threads", common_.threads, "threads to use (0: all)")
        ->check(CLI::Range(0U, 1024U));
    command->callback([this, action = std::move(action)] { action_ = action; });
    return command;
  }

  CLI::Option* add_input(CLI::App* command) {
    command
        ->add_option(
            "--crease-index-base", input_.crease_index_base,
            "`e` lines of an OBJ count vertices from 0 or 1 (default: decided by what fits)")
        ->check(CLI::IsMember({0, 1}));
    command->add_flag("--keep-isolated", input_.keep_isolated, "keep vertices that no face uses");
    command
        ->add_option("--tag-creases", input_.tag_creases_deg,
                     "degrees: edges whose faces meet at more become creases")
        ->check(CLI::Validator(check_angle, "0 TO 180"));
    return command->add_option("MODEL,--input", input_.model,
                               "obj, ply, stl, off, gltf, glb or pm");
  }

  void add_look(CLI::App* command) {
    command->add_option("--size", look_.size, "N or WxH, in pixels");
    command->add_flag("--wireframe", look_.wireframe, "draw the edges");
    command->add_flag("--gouraud", look_.gouraud, "smooth shading (short for --shading gouraud)");
    command->add_option("--shading", look_.shading, "flat (default), gouraud, or none: edges alone")
        ->check(CLI::IsMember({"flat", "gouraud", "none"}));
    command
        ->add_option("--crease-angle", look_.crease_angle_deg,
                     "degrees: Gouraud normals split where faces meet at more (default: 180)")
        ->check(CLI::Validator(check_angle, "0 TO 180"));
    command->add_option("--camera", look_.camera,
                        "YAW,PITCH[,ZOOM]: degrees, and what divides the distance");
    command->add_option("--view", look_.view, "front, right or top")
        ->check(CLI::IsMember({"front", "right", "top"}));
    command->add_flag("--orthographic", look_.orthographic, "no perspective");
    command->add_flag("--dark", look_.dark, "dark background");
    command->add_option("--samples", look_.samples, "samples a pixel: 1 or 4 (default)")
        ->check(CLI::IsMember({1U, 4U}));
    command->add_option("--device", look_.device, "GPU: its number or a part of its name");
    command->add_flag("--validation", look_.validation,
                      "run under the Vulkan validation layer; a message is an error");
  }

  void add_view() {
    CLI::App* command = add_command("view", "show a model in a window", [this] {
      if (input_.model.empty()) input_.model = kDefaultModel;
      run_view(input_, look_, view_, common_);
    });
    add_input(command);
    add_look(command);
    command->add_option("--keys", view_.keys, "keys to press first: \"w g 1 shift+w\"");
    command->add_option("--screenshot", view_.screenshot,
                        "press the keys without a window and write this PNG");
    command->add_flag("--panels", view_.panels, "that PNG shows the panels too");
    command->add_option("--state-log", view_.state_log,
                        "write the viewer's state to this file, a line of JSON a change");
  }

  void add_render() {
    CLI::App* command = add_command("render", "draw a picture without a window", [this] {
      run_render(input_, output_, look_, detail_, common_);
    });
    add_input(command)->required();
    command->add_option("-o,--output", output_, "PNG to write")->required();
    add_detail(command, "simplify to so many faces first",
               "how much detail, 0 (the base that `progressive` would choose) to 1 (all)");
    add_look(command);
  }

  void add_info() {
    CLI::App* command = add_command("info", "counts, topology, measures and repairs of a model",
                                    [this] { run_info(input_, common_); });
    add_input(command)->required();
  }

  void add_convert() {
    CLI::App* command = add_command("convert", "read one format, write another",
                                    [this] { run_convert(input_, output_, ascii_, common_); });
    add_input(command)->required();
    command->add_option("OUT,-o,--output", output_, "file to write")->required();
    command->add_flag("--ascii", ascii_, "PLY and STL as text");
  }

  void add_detail(CLI::App* command, const char* faces, const char* lod) {
    CLI::Option* option = add_faces(command, detail_.faces, faces);
    command->add_option("--lod", detail_.lod, lod)
        ->check(CLI::Validator(check_share, "0 TO 1"))
        ->excludes(option);
  }

  CLI::Option* add_faces(CLI::App* command, std::optional<std::uint32_t>& faces, const char* what) {
    return command->add_option("--faces", faces, what)
        ->check(CLI::Range(1U, std::numeric_limits<std::uint32_t>::max()));
  }

  void add_simplify() {
    CLI::App* command = add_command("simplify", "fewer triangles, by edge collapse",
                                    [this] { run_simplify(input_, output_, simplify_, common_); });
    add_input(command)->required();
    command->add_option("OUT,-o,--output", output_, "file to write")->required();
    CLI::Option* faces = add_faces(command, simplify_.faces, "how many faces to leave");
    command
        ->add_option("--ratio", simplify_.ratio,
                     "the share of the faces to leave: above 0, at most 1")
        ->excludes(faces);
    command->add_option("--max-error", simplify_.max_error,
                        "how far the result may be from the input: model units, or 0.5% of the "
                        "diagonal; with --faces or --ratio, what comes first ends it");
    add_policies(command, simplify_);
    add_prune(command, simplify_);
    command->add_flag("--bound", simplify_.bound,
                      "print a certified upper bound on the distance between input and result");
    command->add_flag("--measure", simplify_.measure,
                      "measure the distance between input and result, and count intersecting pairs "
                      "of faces in both");
  }

  void add_policies(CLI::App* command, SimplifyWords& words) {
    command->add_option("--cost", words.cost, "which edge goes first (default: quadric)")
        ->check(CLI::IsMember(cost_words()));
    command
        ->add_option("--placement", words.placement,
                     "where the vertex goes that two become (default: optimal)")
        ->check(CLI::IsMember(placement_words()));
    command->add_option("--boundary", words.boundary, "preserve (default) or lock")
        ->check(CLI::IsMember({"preserve", "lock"}));
    command
        ->add_option("--crease-angle", words.crease_angle_deg,
                     "degrees: edges whose faces turn by more are creases, too (default: 180)")
        ->check(CLI::Validator(check_angle, "0 TO 180"));
    command->add_option("--seed", words.seed, "of the random policy (default: 1)");
    command->add_flag("--no-intersections", words.no_intersections,
                      "refuse collapses that make faces intersect");
  }

  void add_prune(CLI::App* command, SimplifyWords& words) {
    command->add_flag("--prune", words.prune,
                      "leave out parts that are smaller than the error, for the sake of the rest");
  }

  void add_progressive() {
    CLI::App* command =
        add_command("progressive", "a progressive mesh: every level of detail in one file",
                    [this] { run_progressive(input_, output_, progressive_, common_); });
    add_input(command)->required();
    command->add_option("OUT,-o,--output", output_, "file to write: .pm, or a pipe")->required();
    command
        ->add_option(
            "--base-faces", progressive_.base_faces,
            "faces of the coarsest level (default: 200, or an eighth of a small model; more "
            "where it would be further than 5 % of the diagonal from the model)")
        ->check(CLI::Range(1U, std::numeric_limits<std::uint32_t>::max()));
    command
        ->add_option("--bits", progressive_.coordinate_bits,
                     "round positions to a grid of so many bits a side, 4 to 24 (14 is typical; "
                     "default: lossless)")
        ->check(CLI::Range(4U, 24U));
    add_policies(command, progressive_.simplify);
  }

  void add_extract() {
    CLI::App* command = add_command("extract", "one level of a progressive mesh",
                                    [this] { run_extract(input_, output_, detail_, common_); });
    add_input(command)->required();
    command->add_option("OUT,-o,--output", output_, "file to write")->required();
    add_detail(command, "the finest level of at most so many faces",
               "how much detail, 0 (the base) to 1 (all)");
  }

  void add_lods() {
    CLI::App* command = add_command(
        "lods", "levels of detail: one glTF with MSFT_lod, or a file each (OUT_lod0.obj, ...)",
        [this] { run_lods(input_, output_, lods_, common_); });
    add_input(command)->required();
    command->add_option("OUT,-o,--output", output_, "file to write")->required();
    command->add_option("--ratios", lods_.ratios,
                        "share of the faces of each level, falling (default: 1,0.5,0.25, but no "
                        "level that is further than 5 % of the diagonal from the model)");
    command->add_option("--coverage", lods_.coverage,
                        "share of the screen down to which each level is for, falling (default: "
                        "the next level's ratio; the last: 0)");
    add_policies(command, lods_.simplify);
    add_prune(command, lods_.simplify);
  }

  void add_subdivide() {
    CLI::App* command = add_command("subdivide", "more triangles, on a smooth surface", [this] {
      run_subdivide(input_, output_, subdivide_, common_);
    });
    add_input(command)->required();
    command->add_option("OUT,-o,--output", output_, "file to write")->required();
    command
        ->add_option("--levels", subdivide_.levels,
                     "how often every face is split in four (default: 1)")
        ->check(CLI::Range(0U, 16U));
    const auto add_choice = [&](const char* name, std::string& value,
                                const std::vector<std::string>& words, const char* what) {
      command->add_option(name, value, what)->check(CLI::IsMember(words));
    };
    add_choice("--scheme", subdivide_.scheme, scheme_words(), "where vertices go (default: loop)");
    add_choice("--creases", subdivide_.creases, crease_rules_words(),
               "what sharp edges do: Hoppe et al. 1994 (default), or DeRose et al. 1998, as "
               "OpenSubdiv");
    add_choice("--boundary", subdivide_.boundary, boundary_rounding_words(),
               "whether boundary vertices with one face stay (default: edge-only)");
    add_choice("--crease-decay", subdivide_.decay, crease_decay_words(),
               "how sharpness falls from level to level (default: uniform)");
    command->add_flag("--limit", subdivide_.limit,
                      "move the vertices to the limit surface, and write its normals");
  }

  void add_compare() {
    CLI::App* command =
        add_command("compare", "how far two surfaces lie apart (RMS, mean, max, both ways)",
                    [this] { run_compare(input_, second_, samples_, common_); });
    add_input(command)->required();
    command->add_option("SECOND", second_.model, "the other model")->required();
    command->add_option("--samples", samples_, "points a side, spread evenly over the area")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  }

  CLI::App app_{"mesher: mesh levels of detail, interactive and in batch", "mesher"};
  CommonOptions common_;
  InputOptions input_;
  LookOptions look_;
  ViewOptions view_;
  SimplifyWords simplify_;
  SubdivideWords subdivide_;
  ProgressiveWords progressive_;
  LodWords lods_;
  DetailWords detail_;
  InputOptions second_;
  std::uint64_t samples_ = DistanceOptions{}.samples;
  std::string output_;
  bool ascii_ = false;
  std::function<void()> action_;
};

int fail(const char* what, ExitCode code) {
  std::cerr << "mesher: " << what << '\n';
  return static_cast<int>(code);
}

}  // namespace

int run(int argc, const char* const* argv) {
  CommandLine line;
  try {
    line.parse(argc, argv);
    line.run();
    if (!std::cout.flush()) throw OutputError("stdout", "cannot be written");
    return static_cast<int>(ExitCode::done);
  } catch (const CLI::ParseError& error) {
    return line.explain(error);
  } catch (const Error& error) {
    return fail(error.what(), error.exit_code());
  } catch (const std::bad_alloc&) {
    return fail("not enough memory", ExitCode::machine_lacks);
  } catch (const std::exception& error) {
    return fail(error.what(), ExitCode::machine_lacks);
  }
}

}  // namespace mesher::app

#include "app/cli/run.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <limits>
#include <new>

#include "app/cli/arguments.h"
#include "app/cli/batch.h"
#include "app/cli/command_table.h"
#include "app/cli/compare_command.h"
#include "app/cli/edit_command.h"
#include "app/cli/help_formatter.h"
#include "app/cli/lods_command.h"
#include "app/cli/option_parsing.h"
#include "app/cli/progressive_command.h"
#include "app/cli/render_command.h"
#include "app/cli/simplify_command.h"
#include "app/cli/simplify_flags.h"
#include "app/cli/streams.h"
#include "app/cli/subdivide_command.h"
#include "app/cli/version.h"
#include "app/cli/view.h"
#include "app/document/progressive_view.h"
#include "engine/core/error.h"
#include "engine/core/face_limit.h"
#include "engine/core/memory.h"
#include "engine/core/parallel.h"
#include "engine/core/text.h"
#include "engine/core/time_limit.h"
#include "engine/io/format.h"
#include "engine/io/temporary_files.h"

namespace mesher::app {
namespace {

constexpr const char* kDefaultModel = "bunny.obj";

/// The grammar of the command line, and the parsed values.
class CommandLine {
 public:
  CommandLine() {
    app_.formatter(std::make_shared<HelpFormatter>());
    app_.require_subcommand(1);
    app_.set_version_flag("--version", version_text, "print version, commit and Vulkan device");
    app_.footer(
        "`view` is the default command: mesher bunny.obj\n"
        "Long options work with one dash: mesher -input bunny.obj -size 500 -gouraud\n"
        "A model named without a folder is also searched for in assets/.\n"
        "- is standard input or output; --format names the format of a pipe.\n"
        "Exit codes: 0 done; 1 usage error; 2 unusable input;\n"
        "3 missing device, driver or memory; 4 output cannot be written; 5 --timeout.");
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
    add_edit();
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
    suggestions_ = suggestions(arguments, long_options);
    if (!arguments.empty()) view_.nearest_command = nearest_name(arguments[0], commands);
    arguments = normalized_arguments(std::move(arguments), commands, long_options);
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 expects them
    app_.parse(std::move(arguments));
  }

  void run() {
    const ThreadLimit threads(common_.threads);
    const FaceLimit faces(limits_.faces);
    const TimeLimit time(limits_.seconds, std::chrono::seconds(2), io::remove_temporaries);
    std::optional<MemoryLimit> memory;
    if (!limits_.memory.empty()) {
      memory.emplace(parse_bytes("--max-memory", limits_.memory), MemoryLimit::Of::everything);
    }
    try {
      const Streams streams(stream_names(), formats_);
      action_();
      if (!std::cout.flush()) throw OutputError("stdout", "cannot be written");
    } catch (const Cancelled&) {
      throw Error(ExitCode::timed_out,
                  fmt::format("stopped after {} (--timeout)", seconds_text(limits_.seconds)));
    } catch (const std::bad_alloc&) {
      throw_out_of_memory("");
    }
  }

  const CLI::App& grammar() const { return app_; }

  int explain(const CLI::ParseError& error) const {
    const bool is_help = error.get_exit_code() == 0;
    if (is_help) {
      app_.exit(error, std::cout, std::cerr);
    } else {
      say(error.what());
      for (const std::string& suggestion : suggestions_)
        say(suggestion);
      say("run with --help for more information");
    }
    return static_cast<int>(is_help ? ExitCode::done : ExitCode::usage);
  }

 private:
  /// The files of the parsed command.
  StreamNames stream_names() {
    const std::string command = app_.get_subcommands().front()->get_name();
    StreamNames names;
    names.inputs.push_back(&input_.model);
    if (command == "compare") names.inputs.push_back(&second_.model);
    if (command == "view") names.output = &view_.screenshot;
    if (!output_.empty()) names.output = &output_;
    names.formats = written_formats(command);
    names.output_tells_format = command == "progressive";
    return names;
  }

  void add_formats(CLI::App* command) {
    std::vector<std::string> models;
    for (const io::FormatInfo& format : io::formats())
      models.emplace_back(format.extension + 1);
    std::vector<std::string> all = models;
    all.insert(all.end(), {"png", "webp"});
    command
        ->add_option("--format", formats_.format,
                     "format of the output if its name does not tell it (a pipe), or else of such "
                     "an input (default: the one that the input begins like)")
        ->check(CLI::IsMember(all));
    command->add_option("--input-format", formats_.input_format, "format of the input")
        ->check(CLI::IsMember(models));
  }

  void add_limits(CLI::App* command) {
    command->add_option("--max-memory", limits_.memory,
                        "most memory to allocate at one time: 512MB, 2GiB (default: no limit)");
    command
        ->add_option("--timeout", limits_.seconds,
                     "stop after this time, and write nothing [s] (default: no limit)")
        ->check(number_between(0.001, 1e9));
    command
        ->add_option("--max-faces", limits_.faces,
                     "refuse models and results of more faces (default: no limit)")
        ->check(integer_between(1, std::numeric_limits<std::uint32_t>::max()));
  }

  CLI::App* add_command(const char* name, const char* what, std::function<void()> action) {
    CLI::App* command = app_.add_subcommand(name, what);
    command->add_flag("--json", common_.json, "print one JSON object to stdout");
    command->add_flag("--quiet", common_.quiet, "print errors only");
    command->add_option("--threads", common_.threads, "number of threads; 0: all (default: 0)")
        ->check(CLI::Range(0U, 1024U));
    if (std::string_view(name) != "view") add_limits(command);
    add_formats(command);
    command->callback([this, action = std::move(action)] { action_ = action; });
    return command;
  }

  CLI::Option* add_input(CLI::App* command) {
    command
        ->add_option("--crease-index-base", input_.crease_index_base,
                     "index base of the `e` lines of an OBJ (default: the one that fits)")
        ->check(CLI::IsMember({0, 1}));
    command->add_flag("--keep-isolated", input_.keep_isolated, "keep vertices that no face uses");
    CLI::Option* const no_weld =
        command->add_flag("--no-weld", input_.no_weld, "keep vertices at equal positions apart");
    command
        ->add_option("--weld", input_.weld_distance,
                     "join vertices that are at most this far apart [model units] (default: 0)")
        ->check(number_between(0.0, 1e38))
        ->excludes(no_weld);
    command
        ->add_option("--tag-creases", input_.tag_creases_deg,
                     "mark edges whose face normals differ by more than this as creases [deg]")
        ->check(number_between(0.0, 180.0));
    return command->add_option("MODEL,--input", input_.model, io::readable_formats());
  }

  /// The input of a command without a window, which may not be damaged.
  void add_batch_input(CLI::App* command) {
    add_input(command)->required();
    command->add_flag("--allow-damaged", input_.allow_damaged,
                      "use the intact part of a damaged progressive mesh");
  }

  /// The output of a command.
  void add_output(CLI::App* command, const char* name, const char* what) {
    command->add_option(name, output_, what)->required();
    command->add_flag("--no-fsync", common_.no_fsync,
                      "do not wait until the result is on the disk");
  }

  void add_look(CLI::App* command) {
    add_options(*command, render::kRenderOptions, look_.settings);
    command->add_option("--size", look_.size,
                        "N or WxH [pixels] (default: 800x600; view: 1280x800 points)");
    command->add_flag("--gouraud", look_.gouraud, "short for --shading gouraud");
    command->add_flag("--dark", look_.dark, "short for --background dark");
    command->add_option("--camera", look_.camera,
                        "YAW,PITCH[,ZOOM]: angles [deg] and zoom factor (default: 25,15,1)");
    command->add_option("--view", look_.view, "view along an axis")
        ->check(CLI::IsMember({"front", "right", "top"}));
    command->add_flag("--orthographic", look_.orthographic, "no perspective");
    command->add_option("--device", look_.device, "GPU: its number or part of its name");
    command->add_flag("--validation", look_.validation,
                      "enable the Vulkan validation layer and treat its messages as errors");
  }

  void add_view() {
    CLI::App* command = add_command("view", "show a model in a window", [this] {
      view_.is_sample = input_.model.empty();
      if (view_.is_sample) input_.model = kDefaultModel;
      run_view(input_, look_, view_, common_);
    });
    add_input(command);
    command->add_option("MORE", view_.more, "more models, each in a tab of its own");
    add_look(command);
    command->add_option("--keys", view_.keys, "keys to press at the start: \"w g 1 shift+w\"");
    command->add_option("--screenshot", view_.screenshot,
                        "press the keys without a window and write a picture to this PNG");
    command->add_flag("--panels", view_.panels, "include the panels in that picture");
    command
        ->add_option("--ui-scale", view_.ui_scale,
                     "size of the panels, 0.5 to 4 (default: that of the monitor)")
        ->check(CLI::Range(0.5, 4.0));
    command->add_option("--state-log", view_.state_log,
                        "write the viewer's state to this file, one line of JSON per change");
    command->add_option("--turn-log", view_.turn_log,
                        "write the time of each turn of the window's loop to this file, as JSON");
  }

  void add_render() {
    CLI::App* command = add_command("render", "draw a picture without a window", [this] {
      run_render(input_, output_, look_, picture_, detail_, common_);
    });
    add_batch_input(command);
    add_output(command, "-o,--output",
               "PNG or WebP to write; with --turntable, an animated WebP, or one PNG per frame: "
               "turn_###.png");
    CLI::Option* lod = add_detail(
        command, "simplify to this number of faces first",
        "level of detail, from 0 (the base that `progressive` chooses) to 1 (full detail)");
    command
        ->add_flag("--split-colors", look_.split_colors,
                   "with --lod: color faces by split order, from violet (first) to yellow")
        ->needs(lod);
    add_pose(command, "draw a pose");
    add_look(command);
    add_options(*command, kPictureOptions, picture_.options);
    CLI::Option* turntable =
        command->add_flag("--turntable", picture_.turntable,
                          "draw a full turn around the model instead of one picture");
    for (const Option<TurntableOptions>& option : kTurntableOptions)
      add_option(*command, option, picture_.turn)->needs(turntable);
  }

  /// `does`: what the command does with the pose.
  void add_pose(CLI::App* command, const std::string& does) {
    CLI::Option* animation =
        command
            ->add_option_function<std::string>(
                "--animation", [this](const std::string& name) { input_.animation = name; },
                does +
                    " of this animation of a glTF: its name or index, from 0; without NAME, an "
                    "error lists the animations")
            ->type_name("NAME")
            ->expected(0, 1);
    command
        ->add_option("--time", input_.time_s,
                     "time of that pose; the last pose holds after the end [s] (default: 0)")
        ->check(number_between(0.0, 1e9))
        ->needs(animation);
  }

  void add_info() {
    CLI::App* command =
        add_command("info", "print counts, topology, measures and repairs of a model",
                    [this] { run_info(input_, common_); });
    add_batch_input(command);
  }

  void add_convert() {
    CLI::App* command = add_command("convert", "convert a model to another format", [this] {
      run_convert(input_, output_, ascii_, repairs_, common_);
    });
    add_batch_input(command);
    add_output(command, "OUT,-o,--output", "file to write");
    add_compress(command);
    command->add_flag("--ascii", ascii_, "write PLY and STL as text");
    command->add_flag(
        "--repair", repairs_,
        "glTF to glTF: join vertices and repair the meshes, which are otherwise copied "
        "as they are; other formats are always repaired");
  }

  CLI::Option* add_detail(CLI::App* command, const char* faces, const char* lod) {
    CLI::Option* option = add_faces(*command, detail_.faces, faces);
    return command->add_option("--lod", detail_.lod, lod)
        ->check(number_between(0.0, 1.0))
        ->excludes(option);
  }

  void add_simplify() {
    CLI::App* command = add_command("simplify", "reduce the number of faces by edge collapse",
                                    [this] { run_simplify(input_, output_, simplify_, common_); });
    add_batch_input(command);
    add_output(command, "OUT,-o,--output", "file to write");
    add_simplify_flags(*command, simplify_);
    add_compress(command);
    command->add_flag("--bound", simplify_.bound,
                      "print a certified upper bound on the distance between input and result");
    command->add_flag("--measure", simplify_.measure,
                      "measure the distance between input and result, and count the intersecting "
                      "pairs of faces in both");
  }

  void add_compress(CLI::App* command) {
    command->add_flag("--compress", common_.compresses,
                      "compress the meshes of a glTF output (EXT_meshopt_compression)");
  }

  void add_progressive() {
    CLI::App* command =
        add_command("progressive", "write a progressive mesh: every level of detail in one file",
                    [this] { run_progressive(input_, output_, progressive_, common_); });
    add_batch_input(command);
    add_output(command, "OUT,-o,--output", "file to write: .pm, or a pipe");
    add_option(*command, option_named(kProgressiveOptions, "base-faces"), progressive_.settings)
        ->check(CLI::Range(1U, std::numeric_limits<std::uint32_t>::max()));
    command
        ->add_option("--bits", progressive_.coordinate_bits,
                     "quantize positions to this number of bits per axis, 4 to 24; 14 is typical "
                     "(default: lossless)")
        ->check(CLI::Range(4U, 24U));
    add_options(*command, simplify::kSimplifyRules, progressive_.simplify.rules);
  }

  void add_extract() {
    CLI::App* command = add_command("extract", "write one level of a progressive mesh",
                                    [this] { run_extract(input_, output_, detail_, common_); });
    add_batch_input(command);
    add_output(command, "OUT,-o,--output", "file to write");
    add_detail(command, "the finest level of at most this number of faces",
               "level of detail, from 0 (the base) to 1 (full detail)");
    add_compress(command);
  }

  void add_lods() {
    CLI::App* command = add_command(
        "lods",
        "write levels of detail: one glTF with MSFT_lod, or one file each (OUT_lod0.obj, ...)",
        [this] { run_lods(input_, output_, lods_, common_); });
    add_batch_input(command);
    add_output(command, "OUT,-o,--output", "file to write");
    add_lods_flags(*command, lods_);
    add_compress(command);
  }

  void add_subdivide() {
    CLI::App* command =
        add_command("subdivide", "split each face into four (Loop, butterfly or midpoint)",
                    [this] { run_subdivide(input_, output_, subdivide_, common_); });
    add_batch_input(command);
    add_output(command, "OUT,-o,--output", "file to write");
    command->add_option("--levels", subdivide_.levels, "number of subdivision levels (default: 1)")
        ->check(CLI::Range(0U, 16U));
    add_options(*command, subdivide::kSubdivideRules, subdivide_);
    add_compress(command);
  }

  void add_compare() {
    CLI::App* command = add_command(
        "compare", "measure how much a model differs from another in shape and look", [this] {
          second_.allow_damaged = input_.allow_damaged;
          second_.animation = input_.animation;
          second_.time_s = input_.time_s;
          run_compare(input_, second_, compare_, common_);
        });
    add_batch_input(command);
    command->add_option("SECOND", second_.model, "the other model")->required();
    add_pose(command, "compare both models in a pose");
    add_compare_options(*command, compare_);
  }

  void add_edit() {
    CLI::App* command =
        add_command("edit", "run commands of the window in order, and write the result",
                    [this] { run_edit(input_, output_, script_, common_); });
    add_batch_input(command);
    add_output(command, "OUT,-o,--output", "file to write");
    command
        ->add_option("--do", script_,
                     "commands and edits, separated by semicolons: \"subdivide; simplify_to "
                     "faces=500\" (docs/reference.md lists them)")
        ->required();
  }

  CLI::App app_{"mesher: a mesh level-of-detail workbench", "mesher"};
  CommonOptions common_;
  LimitOptions limits_;
  FormatArguments formats_;
  InputOptions input_;
  LookOptions look_;
  ViewOptions view_;
  SimplifyArguments simplify_;
  subdivide::SubdivideOptions subdivide_;
  ProgressiveArguments progressive_;
  LodArguments lods_;
  DetailArguments detail_;
  PictureArguments picture_;
  InputOptions second_;
  CompareArguments compare_;
  std::string output_;
  std::string script_;
  std::vector<std::string> suggestions_;  ///< for a command line that cannot be parsed
  bool ascii_ = false;
  bool repairs_ = false;
  std::function<void()> action_;
};

int fail(const char* what, ExitCode code) {
  say(what);
  return static_cast<int>(code);
}

}  // namespace

CommandTable command_table() {
  return command_table(CommandLine().grammar());
}

int run(int argc, const char* const* argv) {
  CommandLine line;
  try {
    line.parse(argc, argv);
    line.run();
    return static_cast<int>(ExitCode::done);
  } catch (const CLI::ParseError& error) {
    return line.explain(error);
  } catch (const Error& error) {
    return fail(error.what(), error.exit_code());
  } catch (const std::bad_alloc&) {
    return fail("out of memory", ExitCode::machine_lacks);
  } catch (const std::exception& error) {
    return fail(error.what(), ExitCode::machine_lacks);
  }
}

}  // namespace mesher::app

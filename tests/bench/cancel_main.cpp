// bench_cancel KIND FOLDER MOMENTS: cancels one kind of the window's jobs at so many moments, and
// prints a line of JSON. "cancel_ms": for each moment, the time until the window is rid of the job.
// "gone_ms": the same until its thread has ended and its memory is free. "job_ms": the time of the
// whole job. FOLDER holds large.EXT, one model in every format, and medium.ply.
// bench_cancel --list: lists the kinds.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "app/document/session.h"
#include "app/edit/edit_runner.h"
#include "app/edit/edits.h"
#include "app/edit/progressive_edits.h"
#include "app/files/load_job.h"
#include "app/files/picture_task.h"
#include "app/files/save.h"
#include "engine/core/canceled_jobs.h"
#include "engine/io/read.h"
#include "engine/mesh/delta.h"
#include "engine/mesh/shape.h"
#include "tests/support/temp_folder.h"

namespace mesher::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Json = nlohmann::json;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void nap() {
  std::this_thread::sleep_for(std::chrono::microseconds(200));
}

/// A kind of job, as the window runs it.
class Cancelable {
 public:
  virtual ~Cancelable() = default;
  virtual void start() = 0;
  virtual bool is_running() = 0;
  /// Cancels the job as the window does. Returns false if it could not be canceled any more.
  virtual bool cancel() = 0;
  /// Waits until nothing of the job is left.
  virtual void wait() = 0;
  /// Throws if a canceled job has left a trace.
  virtual void check_unchanged() = 0;
};

/// A job of a T.
template <class T>
class JobRun : public Cancelable {
 public:
  using Make = std::function<std::unique_ptr<JobOf<T>>()>;
  explicit JobRun(Make make) : make_(std::move(make)) {}

  void start() override { job_ = make_(); }
  bool is_running() override { return !job_->is_done(); }
  bool cancel() override { return canceled_.take(job_); }
  void wait() override {
    job_.reset();
    for (; !canceled_.is_empty(); nap())
      canceled_.reap();
  }
  void check_unchanged() override {}

 private:
  Make make_;
  std::unique_ptr<JobOf<T>> job_;
  CanceledJobs canceled_;
};

/// A job that writes into a folder.
class WriteRun : public Cancelable {
 public:
  using Write = std::function<void(const fs::path& folder, Progress&)>;
  explicit WriteRun(Write write) : write_(std::move(write)) {}

  void start() override {
    folder_ = std::make_unique<test::TempFolder>();
    run_.start();
  }
  bool is_running() override { return run_.is_running(); }
  bool cancel() override { return run_.cancel(); }
  void wait() override { run_.wait(); }
  void check_unchanged() override {
    if (folder_->count_files() > 0) throw std::runtime_error("a canceled job has written a file");
  }

 private:
  Write write_;
  std::unique_ptr<test::TempFolder> folder_;
  JobRun<int> run_{[this] {
    const auto work = [this](Progress& progress) {
      write_(folder_->path(), progress);
      return 0;
    };
    return std::make_unique<JobOf<int>>("Writing", work, nullptr);
  }};
};

/// An edit of a model.
class EditRun : public Cancelable {
 public:
  using Request = std::function<void(app::Document&)>;
  EditRun(Model&& model, Request request) : request_(std::move(request)) {
    app::show_model(session_, std::move(model), "model.obj");
    before_ = session_.document.model.mesh;
  }

  void start() override {
    runner_ = std::make_unique<app::EditRunner>(session_.document, nullptr);
    request_(session_.document);
    runner_->advance();
    if (!runner_->is_running())
      throw std::runtime_error("no edit: " + session_.document.notice + session_.document.error);
  }
  bool is_running() override { return !runner_->job()->is_done(); }
  bool cancel() override {
    runner_->cancel();
    return true;  // its result is dropped if it had ended
  }
  void wait() override { runner_.reset(); }
  void check_unchanged() override {
    const app::Document& document = session_.document;
    if (document.progressive.has_mesh() || document.edits.history.undo_depth() > 0 ||
        !difference(before_, document.model.mesh).is_empty())
      throw std::runtime_error("a canceled edit has changed the document");
  }

 private:
  Request request_;
  app::Session session_;
  Mesh before_;
  std::unique_ptr<app::EditRunner> runner_;
};

Model large(const fs::path& folder) {
  return io::read_model(folder / "large.ply");
}

Model medium(const fs::path& folder) {
  return io::read_model(folder / "medium.ply");
}

using Making = std::function<std::unique_ptr<Cancelable>(const fs::path& folder)>;

Making opening(const char* file) {
  return [file](const fs::path& folder) {
    return std::make_unique<JobRun<app::LoadedModel>>([path = folder / file] {
      return std::make_unique<app::LoadJob>(path, app::LoadOptions{}, nullptr);
    });
  };
}

Making saving(const char* file) {
  return [file](const fs::path& folder) {
    auto shape = std::make_shared<app::Shape>();
    Model model = large(folder);
    shape->mesh = std::move(model.mesh);
    shape->attributes = std::move(model.attributes);
    return std::make_unique<WriteRun>([shape, file](const fs::path& into, Progress& progress) {
      app::SaveTask task;
      task.file = into / file;
      task.shape = shape;
      app::perform(task, &progress);
    });
  };
}

using Reading = std::function<Model(const fs::path& folder)>;

Making edit(const Reading& model, const EditRun::Request& request) {
  return [model, request](const fs::path& folder) {
    return std::make_unique<EditRun>(model(folder), request);
  };
}

Model armadillo(const fs::path&) {
  return io::read_model(fs::path(MESHER_SHARED_MODELS) / "armadillo.obj");
}

app::Session window_with(Model&& model) {
  app::Session session;
  session.view.window = {1400.0, 900.0};
  app::show_model(session, std::move(model), "model.obj");
  session.view.settings.wireframe = true;
  return session;
}

Making picture(const Reading& model, const app::PictureRequest& request) {
  return [model, request](const fs::path& folder) {
    auto session = std::make_shared<app::Session>(window_with(model(folder)));
    return std::make_unique<WriteRun>([session, request](const fs::path& into, Progress& progress) {
      app::PictureRequest its = request;
      its.file = into / request.file;
      app::PictureTask task = app::begin_picture(session->document, session->view, its);
      app::perform(task, &progress);
    });
  };
}

struct Kind {
  std::string_view name;
  Making make;
};

std::vector<Kind> kinds() {
  return {
      {"open_obj", opening("large.obj")},
      {"open_ply", opening("large.ply")},
      {"open_stl", opening("large.stl")},
      {"open_off", opening("large.off")},
      {"open_glb", opening("large.glb")},
      {"save_obj", saving("a.obj")},
      {"save_ply", saving("a.ply")},
      {"save_stl", saving("a.stl")},
      {"save_glb", saving("a.glb")},
      {"save_pm", saving("a.pm")},
      {"simplify", edit(large, app::request_remove_tenth)},
      {"simplify_far",
       edit(large, [](app::Document& document) { app::request_simplify_to(document, 10'000); })},
      {"subdivide", edit(medium, app::request_subdivide)},
      {"subdivide_limit", edit(medium,
                               [](app::Document& document) {
                                 document.subdivide.limit = true;
                                 app::request_subdivide(document);
                               })},
      {"progressive", edit(large, app::toggle_progressive)},
      {"picture_png", picture(armadillo, {.file = "a.png", .options = {.scale = 8}})},
      {"picture_supersampled",
       picture(armadillo, {.file = "a.png", .options = {.scale = 4, .supersample = 3}})},
      {"picture_webp", picture(armadillo, {.file = "a.webp", .options = {.scale = 8}})},
      {"picture_large", picture(large, {.file = "a.png", .options = {.scale = 2}})},
      {"turn_webp", picture(armadillo, {.file = "a.webp",
                                        .options = {.scale = 4},
                                        .turn = app::TurntableOptions{.frames = 4}})},
      {"turn_png", picture(armadillo, {.file = "a_#.png",
                                       .options = {.scale = 4},
                                       .turn = app::TurntableOptions{.frames = 6}})},
  };
}

/// Cancels at one random moment in each of `moments` equal parts of the job's time.
Json measure(Cancelable& job, int moments) {
  const Clock::time_point start = Clock::now();
  job.start();
  while (job.is_running())
    nap();
  const double job_ms = ms_since(start);
  job.cancel();
  job.wait();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> within(0.0, 1.0);
  Json json{{"job_ms", job_ms}, {"cancel_ms", Json::array()}, {"gone_ms", Json::array()}};
  for (int i = 0; i < moments; ++i) {
    const double at = (i + within(random)) / moments;
    job.start();
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(at * job_ms));
    const Clock::time_point moment = Clock::now();
    const bool is_canceled = job.cancel();
    const double cancel_ms = ms_since(moment);
    job.wait();
    if (!is_canceled) continue;
    json["cancel_ms"].push_back(cancel_ms);
    json["gone_ms"].push_back(ms_since(moment));
    job.check_unchanged();
  }
  return json;
}

}  // namespace
}  // namespace mesher::bench

int main(int argc, char** argv) {
  using namespace mesher::bench;
  if (argc != 4 && !(argc == 2 && std::strcmp(argv[1], "--list") == 0)) {
    std::fprintf(stderr, "usage: bench_cancel KIND FOLDER MOMENTS | --list\n");
    return 1;
  }
  try {
    for (const Kind& kind : kinds()) {
      if (argc == 2) {
        std::printf("%s\n", kind.name.data());
      } else if (kind.name == argv[1]) {
        std::printf("%s\n", measure(*kind.make(argv[2]), std::atoi(argv[3])).dump().c_str());
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_cancel: %s\n", error.what());
    return 1;
  }
  return 0;
}

#include "app/progressive_commands.h"

namespace mesher::app {
namespace {

/// Of the slider's length.
constexpr double kStep = 0.1;

std::string on_off(bool is_on) {
  return is_on ? " on" : " off";
}

void change_settings(Session& session, Command command) {
  ProgressiveSettings settings = session.progressive.settings();
  if (command == Command::toggle_geomorphs) {
    settings.geomorphs = !settings.geomorphs;
    session.notice = settings.geomorphs ? "splits grow" : "splits pop";
  } else if (command == Command::toggle_automatic) {
    settings.is_automatic = !settings.is_automatic;
    session.notice = "automatic level" + on_off(settings.is_automatic);
  } else {
    settings.colors_by_split_order = !settings.colors_by_split_order;
    session.notice = "colors by birth" + on_off(settings.colors_by_split_order);
  }
  session.progressive.change(settings);
}

}  // namespace

void run_progressive(Session& session, Command command) {
  ProgressiveView& view = session.progressive;
  if (!view.is_on()) {
    session.notice = "P shows the model as a progressive mesh; then this key means something";
    return;
  }
  switch (command) {
    case Command::play:
      return view.play(!view.is_playing());
    case Command::one_split_down:
      return view.move_by(-1);
    case Command::one_split_up:
      return view.move_by(1);
    case Command::detail_down:
      return view.move_to(view.position() - kStep);
    case Command::detail_up:
      return view.move_to(view.position() + kStep);
    case Command::least_detail:
      return view.move_to(0.0);
    case Command::most_detail:
      return view.move_to(1.0);
    default:
      return change_settings(session, command);
  }
}

}  // namespace mesher::app

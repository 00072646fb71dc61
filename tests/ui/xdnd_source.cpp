#include "tests/ui/xdnd_source.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <chrono>
#include <thread>

namespace mesher::test {
namespace {

using namespace std::chrono_literals;

std::string uri_list(const std::vector<std::string>& paths) {
  std::string list;
  for (const std::string& path : paths)
    list += "file://" + path + "\r\n";
  return list;
}

class Source {
 public:
  Source(const std::string& display_name, ::Window target, const std::vector<std::string>& paths)
      : display_(XOpenDisplay(display_name.c_str())), target_(target), uris_(uri_list(paths)) {
    own_ = XCreateSimpleWindow(display_, DefaultRootWindow(display_), 0, 0, 1, 1, 0, 0, 0);
    XSetSelectionOwner(display_, atom("XdndSelection"), own_, CurrentTime);
  }
  ~Source() {
    XDestroyWindow(display_, own_);
    XCloseDisplay(display_);
  }
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  bool run() {
    send("XdndEnter", 5L << 24, static_cast<long>(atom("text/uri-list")), 0, 0);
    send("XdndPosition", 0, (200L << 16) | 200L, CurrentTime,
         static_cast<long>(atom("XdndActionCopy")));
    if (!wait_for("XdndStatus")) return false;
    send("XdndDrop", 0, CurrentTime, 0, 0);
    return wait_for("XdndFinished");
  }

 private:
  Atom atom(const char* name) const { return XInternAtom(display_, name, False); }

  void send(const char* type, long a, long b, long c, long d) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target_;
    event.xclient.message_type = atom(type);
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(own_);
    event.xclient.data.l[1] = a;
    event.xclient.data.l[2] = b;
    event.xclient.data.l[3] = c;
    event.xclient.data.l[4] = d;
    XSendEvent(display_, target_, False, NoEventMask, &event);
    XFlush(display_);
  }

  void hand_over(const XSelectionRequestEvent& request) {
    XChangeProperty(display_, request.requestor, request.property, request.target, 8,
                    PropModeReplace, reinterpret_cast<const unsigned char*>(uris_.data()),
                    static_cast<int>(uris_.size()));
    XEvent answer{};
    answer.xselection.type = SelectionNotify;
    answer.xselection.requestor = request.requestor;
    answer.xselection.selection = request.selection;
    answer.xselection.target = request.target;
    answer.xselection.property = request.property;
    answer.xselection.time = request.time;
    XSendEvent(display_, request.requestor, False, NoEventMask, &answer);
    XFlush(display_);
  }

  bool wait_for(const char* message) {
    const auto end = std::chrono::steady_clock::now() + 30s;
    while (std::chrono::steady_clock::now() < end) {
      if (XPending(display_) == 0) {
        std::this_thread::sleep_for(10ms);
        continue;
      }
      XEvent event{};
      XNextEvent(display_, &event);
      if (event.type == SelectionRequest) hand_over(event.xselectionrequest);
      if (event.type == ClientMessage && event.xclient.message_type == atom(message)) return true;
    }
    return false;
  }

  Display* display_;
  ::Window target_;
  ::Window own_;
  std::string uris_;
};

}  // namespace

bool drop_file(const std::string& display_name, unsigned long target, const std::string& path) {
  return drop_files(display_name, target, {path});
}

bool drop_files(const std::string& display_name, unsigned long target,
                const std::vector<std::string>& paths) {
  return Source(display_name, target, paths).run();
}

}  // namespace mesher::test

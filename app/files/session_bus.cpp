#include "app/files/session_bus.h"

#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <stop_token>
#include <string_view>
#include <thread>

#include "app/files/cancel_link.h"

namespace mesher::app {
namespace {

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view{} : value;
}

bool is_own_socket(const std::string& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 && S_ISSOCK(status.st_mode) && status.st_uid == getuid();
}

/// Returns the addresses of the list, which is separated by semicolons, that start nothing.
std::string without_autolaunch(std::string_view list) {
  std::string kept;
  while (!list.empty()) {
    const std::string_view address = list.substr(0, list.find(';'));
    list.remove_prefix(std::min(list.size(), address.size() + 1));
    if (address.empty() || address.starts_with("autolaunch:")) continue;
    if (!kept.empty()) kept += ';';
    kept += address;
  }
  return kept;
}

/// Cancels `target` after some time, unless it is destroyed before.
class Deadline {
 public:
  Deadline(GCancellable* target, std::chrono::milliseconds limit)
      : thread_([target, limit](const std::stop_token& ended) {
          std::mutex mutex;
          std::unique_lock lock(mutex);
          std::condition_variable_any is_ended;
          is_ended.wait_for(lock, ended, limit, [] { return false; });
          if (!ended.stop_requested()) g_cancellable_cancel(target);
        }) {}

 private:
  std::jthread thread_;
};

void cancel_too(GCancellable* /*source*/, void* target) {
  g_cancellable_cancel(static_cast<GCancellable*>(target));
}

/// Ends all reading and writing of a stream, also on other threads.
void shut_down(GCancellable* /*source*/, void* stream) {
  if (!G_IS_SOCKET_CONNECTION(stream)) return;
  GSocket* socket = g_socket_connection_get_socket(G_SOCKET_CONNECTION(stream));
  shutdown(g_socket_get_fd(socket), SHUT_RDWR);
}

}  // namespace

std::string session_bus_address() {
  const std::string_view given = environment("DBUS_SESSION_BUS_ADDRESS");
  if (!given.empty()) return without_autolaunch(given);
  const std::string_view folder = environment("XDG_RUNTIME_DIR");
  const std::string path = std::string(folder) + "/bus";
  if (folder.empty() || !is_own_socket(path)) return {};
  return "unix:path=" + std::string(GlibText(g_dbus_address_escape_value(path.c_str())).get());
}

GlibHandle<GDBusConnection> connect_to_bus(const std::string& address, GCancellable* stop,
                                           std::chrono::milliseconds limit) {
  const GlibHandle<GCancellable> attempt(g_cancellable_new());
  const CancelLink by_caller(stop, cancel_too, attempt.get());
  const Deadline by_time(attempt.get(), limit);
  GlibError error;
  const GlibHandle<GIOStream> stream(
      g_dbus_address_get_stream_sync(address.c_str(), nullptr, attempt.get(), error.out()));
  if (!stream) throw BusError("cannot reach the session bus: " + error.message());
  // The last step, a call of "Hello", ignores the cancellable. Without a socket it fails at once.
  const CancelLink by_shutdown(attempt.get(), shut_down, stream.get());
  constexpr auto kFlags =
      static_cast<GDBusConnectionFlags>(G_DBUS_CONNECTION_FLAGS_AUTHENTICATION_CLIENT |
                                        G_DBUS_CONNECTION_FLAGS_MESSAGE_BUS_CONNECTION);
  GlibHandle<GDBusConnection> connection(g_dbus_connection_new_sync(
      stream.get(), nullptr, kFlags, nullptr, attempt.get(), error.out()));
  if (!connection) throw BusError("cannot use the session bus: " + error.message());
  return connection;
}

void flush(GDBusConnection* connection, std::chrono::milliseconds limit) {
  const GlibHandle<GCancellable> attempt(g_cancellable_new());
  const CancelLink by_shutdown(attempt.get(), shut_down, g_dbus_connection_get_stream(connection));
  const Deadline by_time(attempt.get(), limit);
  g_dbus_connection_flush_sync(connection, nullptr, nullptr);
}

}  // namespace mesher::app

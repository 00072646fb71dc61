#include "app/files/file_portal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "app/files/cancel_link.h"
#include "app/files/session_bus.h"

namespace mesher::app {
namespace {

constexpr char kPortalName[] = "org.freedesktop.portal.Desktop";
constexpr char kPortalPath[] = "/org/freedesktop/portal/desktop";
constexpr char kChooser[] = "org.freedesktop.portal.FileChooser";
constexpr char kRequest[] = "org.freedesktop.portal.Request";
constexpr char kBusName[] = "org.freedesktop.DBus";
constexpr char kBusPath[] = "/org/freedesktop/DBus";
/// Part of the request's path. It is constant, because each dialog has a connection of its own.
constexpr char kToken[] = "mesher";

constexpr std::chrono::milliseconds kConnectLimit{3000};
/// Includes the time to start the portal.
constexpr int kProbeMilliseconds = 25'000;
/// A portal answers before it shows the dialog, so the person waits no longer than this for
/// another one.
constexpr int kReplyMilliseconds = 5'000;
constexpr std::chrono::milliseconds kFlushLimit{50};
/// Portals before this version have no starting folder when opening.
constexpr guint32 kFirstVersionWithFolder = 4;

/// The default context of this thread, where signals of the bus are handled.
class OwnContext {
 public:
  OwnContext() : context_(g_main_context_new()) {
    g_main_context_push_thread_default(context_.get());
  }
  ~OwnContext() {
    while (g_main_context_iteration(context_.get(), FALSE)) {
    }
    g_main_context_pop_thread_default(context_.get());
  }
  OwnContext(const OwnContext&) = delete;
  OwnContext& operator=(const OwnContext&) = delete;

  GMainContext* get() const { return context_.get(); }

 private:
  GlibHandle<GMainContext> context_;
};

struct BusMethod {
  const char* destination;
  const char* path;
  const char* interface;
  const char* name;
};

/// Calls a method and returns the reply, which is of type `reply`. Throws BusError.
GlibHandle<GVariant> call_method(GDBusConnection* bus, const BusMethod& method, GVariant* arguments,
                                 const char* reply, int milliseconds, GCancellable* stop) {
  GlibError error;
  GlibHandle<GVariant> result(g_dbus_connection_call_sync(
      bus, method.destination, method.path, method.interface, method.name, arguments,
      G_VARIANT_TYPE(reply), G_DBUS_CALL_FLAGS_NONE, milliseconds, stop, error.out()));
  if (!result) throw BusError("the desktop's file dialog failed: " + error.message());
  return result;
}

guint32 chooser_version(GDBusConnection* bus, int milliseconds, GCancellable* stop) {
  const GlibHandle<GVariant> reply =
      call_method(bus, {kPortalName, kPortalPath, "org.freedesktop.DBus.Properties", "Get"},
                  g_variant_new("(ss)", kChooser, "version"), "(v)", milliseconds, stop);
  GVariant* inner = nullptr;
  g_variant_get(reply.get(), "(v)", &inner);
  const GlibHandle<GVariant> version(inner);
  if (!g_variant_is_of_type(inner, G_VARIANT_TYPE_UINT32)) {
    throw BusError("the desktop's file dialog failed: its version is not a number");
  }
  return g_variant_get_uint32(inner);
}

/// Returns the unique name of the program that is the portal.
std::string portal_owner(GDBusConnection* bus, GCancellable* stop) {
  const GlibHandle<GVariant> reply =
      call_method(bus, {kBusName, kBusPath, kBusName, "GetNameOwner"},
                  g_variant_new("(s)", kPortalName), "(s)", kReplyMilliseconds, stop);
  const char* name = nullptr;
  g_variant_get(reply.get(), "(&s)", &name);
  return name;
}

/// D-Bus accepts only valid UTF-8; names of files may be anything.
GVariant* text_variant(const std::string& text) {
  return g_variant_new_take_string(
      g_utf8_make_valid(text.data(), static_cast<gssize>(text.size())));
}

/// Portals compare patterns with case, so each letter becomes both: "*.[oO][bB][jJ]".
std::string without_case(const std::string& pattern) {
  std::string both;
  for (const char c : pattern) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalpha(byte) == 0) {
      both += c;
    } else {
      both +=
          {'[', static_cast<char>(std::tolower(byte)), static_cast<char>(std::toupper(byte)), ']'};
    }
  }
  return both;
}

GVariant* filters_variant(const std::vector<FileFilter>& filters) {
  GVariantBuilder list;
  g_variant_builder_init(&list, G_VARIANT_TYPE("a(sa(us))"));
  for (const FileFilter& filter : filters) {
    constexpr guint32 kPattern = 0;  // 1 would be a MIME type
    GVariantBuilder patterns;
    g_variant_builder_init(&patterns, G_VARIANT_TYPE("a(us)"));
    for (const std::string& pattern : filter.patterns) {
      g_variant_builder_add(&patterns, "(u@s)", kPattern, text_variant(without_case(pattern)));
    }
    g_variant_builder_add(&list, "(@sa(us))", text_variant(filter.name), &patterns);
  }
  return g_variant_builder_end(&list);
}

GVariant* folder_variant(const std::filesystem::path& folder) {
  std::error_code ignored;
  const std::filesystem::path absolute = std::filesystem::absolute(folder, ignored);
  return g_variant_new_bytestring(absolute.c_str());
}

/// Returns the arguments of OpenFile or SaveFile.
GVariant* chooser_arguments(const PortalQuestion& question, guint32 version) {
  const FileDialog& dialog = question.dialog;
  GVariantBuilder options;
  g_variant_builder_init(&options, G_VARIANT_TYPE_VARDICT);
  const auto add = [&options](const char* key, GVariant* value) {
    g_variant_builder_add(&options, "{sv}", key, value);
  };
  add("handle_token", g_variant_new_string(kToken));
  add("modal", g_variant_new_boolean(TRUE));
  if (!dialog.filters.empty()) add("filters", filters_variant(dialog.filters));
  if (!dialog.folder.empty() && (question.saves || version >= kFirstVersionWithFolder)) {
    add("current_folder", folder_variant(dialog.folder));
  }
  if (question.allows_several && !question.saves) add("multiple", g_variant_new_boolean(TRUE));
  if (question.saves && !question.suggested_name.empty()) {
    add("current_name", text_variant(question.suggested_name));
  }
  return g_variant_new("(@s@sa{sv})", text_variant(dialog.parent), text_variant(dialog.title),
                       &options);
}

DialogAnswer portal_failed(std::string problem) {
  return {.outcome = DialogOutcome::failed, .problem = std::move(problem)};
}

/// Returns the file of a "file:" address, or none if it is not on this computer.
std::optional<std::filesystem::path> path_of_uri(const char* uri) {
  char* host_text = nullptr;
  const GlibText name(g_filename_from_uri(uri, &host_text, nullptr));
  const GlibText host(host_text);
  if (!name || (host && std::string_view(host.get()) != "localhost")) return std::nullopt;
  return std::filesystem::path(name.get());
}

/// Reads the results of a dialog that was confirmed.
DialogAnswer chosen_files(GVariant* results, bool allows_several) {
  const GlibHandle<GVariant> uris(
      g_variant_lookup_value(results, "uris", G_VARIANT_TYPE_STRING_ARRAY));
  const gsize count = uris ? g_variant_n_children(uris.get()) : 0;
  if (count == 0) return portal_failed("the desktop's file dialog returned no file");
  if (count > 1 && !allows_several) {
    return portal_failed("the desktop's file dialog returned several files instead of one");
  }
  DialogAnswer answer{.outcome = DialogOutcome::chosen};
  for (gsize i = 0; i < count; ++i) {
    const char* uri = nullptr;
    g_variant_get_child(uris.get(), i, "&s", &uri);
    std::optional<std::filesystem::path> file = path_of_uri(uri);
    if (!file) {
      return {.outcome = DialogOutcome::refused,
              .problem = std::string(uri) + " is not a file on this computer; copy it here first"};
    }
    answer.files.push_back(std::move(*file));
  }
  return answer;
}

/// Returns the path of the request that the portal makes for this connection.
std::string request_path(GDBusConnection* bus) {
  std::string sender = g_dbus_connection_get_unique_name(bus) + 1;  // without the colon
  std::ranges::replace(sender, '.', '_');
  return fmt::format("{}/request/{}/{}", kPortalPath, sender, kToken);
}

void wake_context(GCancellable* /*source*/, void* context) {
  g_main_context_wakeup(static_cast<GMainContext*>(context));
}

/// One dialog. Uses the default context of its thread.
class PortalDialog {
 public:
  /// `owner`: the unique name of the portal.
  PortalDialog(GDBusConnection* bus, std::string owner, bool allows_several)
      : bus_(bus),
        owner_(std::move(owner)),
        allows_several_(allows_several),
        request_(request_path(bus)),
        // Listening starts before the call, so that no answer is missed, and on all paths, because
        // the portal may choose another one.
        on_response_(g_dbus_connection_signal_subscribe(
            bus, owner_.c_str(), kRequest, "Response", nullptr, nullptr, G_DBUS_SIGNAL_FLAGS_NONE,
            &PortalDialog::take_response, this, nullptr)),
        on_owner_(g_dbus_connection_signal_subscribe(
            bus, kBusName, kBusName, "NameOwnerChanged", kBusPath, owner_.c_str(),
            G_DBUS_SIGNAL_FLAGS_NONE, &PortalDialog::take_owner_change, this, nullptr)),
        on_closed_(
            g_signal_connect(bus, "closed", G_CALLBACK(&PortalDialog::take_closed_bus), this)) {}

  /// Closes the dialog if it is still open.
  ~PortalDialog() {
    g_signal_handler_disconnect(bus_, on_closed_);
    g_dbus_connection_signal_unsubscribe(bus_, on_owner_);
    g_dbus_connection_signal_unsubscribe(bus_, on_response_);
    if (!is_shown_ || answer_) return;
    g_dbus_connection_call(bus_, owner_.c_str(), request_.c_str(), kRequest, "Close", nullptr,
                           nullptr, G_DBUS_CALL_FLAGS_NO_AUTO_START, -1, nullptr, nullptr, nullptr);
    flush(bus_, kFlushLimit);
  }
  PortalDialog(const PortalDialog&) = delete;
  PortalDialog& operator=(const PortalDialog&) = delete;

  /// Shows the dialog. `method`: OpenFile or SaveFile. Throws BusError.
  void show(const char* method, GVariant* arguments, GCancellable* stop) {
    is_shown_ = true;  // also if the call fails: the portal may be late
    const GlibHandle<GVariant> reply =
        call_method(bus_, {owner_.c_str(), kPortalPath, kChooser, method}, arguments, "(o)",
                    kReplyMilliseconds, stop);
    const char* path = nullptr;
    g_variant_get(reply.get(), "(&o)", &path);
    request_ = path;
  }

  /// Waits for the dialog's end; none: `stop` was canceled.
  std::optional<DialogAnswer> wait(GMainContext* context, GCancellable* stop) {
    // GLib's own source for this leaks if it is destroyed while it is being canceled.
    const CancelLink link(stop, wake_context, context);
    while (!answer_ && !g_cancellable_is_cancelled(stop)) {
      g_main_context_iteration(context, TRUE);
    }
    return answer_;
  }

 private:
  void end(DialogAnswer answer) {
    if (!answer_) answer_ = std::move(answer);
  }

  static void take_response(GDBusConnection* /*bus*/, const char* /*sender*/, const char* path,
                            const char* /*interface*/, const char* /*signal*/, GVariant* arguments,
                            void* data) {
    auto& self = *static_cast<PortalDialog*>(data);
    if (path != self.request_) return;
    if (!g_variant_is_of_type(arguments, G_VARIANT_TYPE("(ua{sv})"))) {
      return self.end(portal_failed("the desktop's file dialog returned something unknown"));
    }
    guint32 code = 0;
    GVariant* dictionary = nullptr;
    g_variant_get(arguments, "(u@a{sv})", &code, &dictionary);
    const GlibHandle<GVariant> results(dictionary);
    constexpr guint32 kConfirmed = 0;
    constexpr guint32 kCanceled = 1;
    if (code == kConfirmed) return self.end(chosen_files(dictionary, self.allows_several_));
    if (code == kCanceled) return self.end({.outcome = DialogOutcome::canceled});
    self.end(portal_failed("the desktop's file dialog ended without an answer"));
  }

  static void take_owner_change(GDBusConnection* /*bus*/, const char* /*sender*/,
                                const char* /*path*/, const char* /*interface*/,
                                const char* /*signal*/, GVariant* /*arguments*/, void* data) {
    // Unique names are never given again, so that the only change is the end of the program.
    static_cast<PortalDialog*>(data)->end(portal_failed("the desktop's file dialog has crashed"));
  }

  static void take_closed_bus(GDBusConnection* /*bus*/, gboolean /*by_bus*/, GError* /*error*/,
                              void* data) {
    static_cast<PortalDialog*>(data)->end(portal_failed("the session bus has ended"));
  }

  GDBusConnection* bus_;
  std::string owner_;
  bool allows_several_;
  std::string request_;
  guint on_response_;
  guint on_owner_;
  gulong on_closed_;
  bool is_shown_ = false;
  std::optional<DialogAnswer> answer_;
};

}  // namespace

bool has_file_portal(const std::string& address, GCancellable* stop) {
  const OwnContext context;
  try {
    const GlibHandle<GDBusConnection> bus = connect_to_bus(address, stop, kConnectLimit);
    return chooser_version(bus.get(), kProbeMilliseconds, stop) > 0;
  } catch (const BusError&) {
    return false;
  }
}

DialogAnswer ask_file_portal(const std::string& address, const PortalQuestion& question,
                             GCancellable* stop) {
  const OwnContext context;
  try {
    const GlibHandle<GDBusConnection> bus = connect_to_bus(address, stop, kConnectLimit);
    const guint32 version = chooser_version(bus.get(), kReplyMilliseconds, stop);
    PortalDialog dialog(bus.get(), portal_owner(bus.get(), stop),
                        question.allows_several && !question.saves);
    dialog.show(question.saves ? "SaveFile" : "OpenFile", chooser_arguments(question, version),
                stop);
    return dialog.wait(context.get(), stop).value_or(DialogAnswer{});
  } catch (const BusError& error) {
    if (g_cancellable_is_cancelled(stop)) return {};
    return portal_failed(error.what());
  }
}

}  // namespace mesher::app

#pragma once

#include <gio/gio.h>

#include <memory>
#include <string>

namespace mesher::app {

/// Deleters for what GLib counts or allocates.
struct GlibRelease {
  void operator()(void* object) const { g_object_unref(object); }
  void operator()(GVariant* variant) const { g_variant_unref(variant); }
  void operator()(GMainContext* context) const { g_main_context_unref(context); }
};
struct GlibFree {
  void operator()(void* memory) const { g_free(memory); }
};

/// One reference to an object, a variant or a context.
template <class T>
using GlibHandle = std::unique_ptr<T, GlibRelease>;
using GlibText = std::unique_ptr<char, GlibFree>;

/// Receives the error of a call: `f(..., error.out())`.
class GlibError {
 public:
  GlibError() = default;
  ~GlibError() { g_clear_error(&error_); }
  GlibError(const GlibError&) = delete;
  GlibError& operator=(const GlibError&) = delete;

  GError** out() {
    g_clear_error(&error_);
    return &error_;
  }
  /// Returns the message, without the name that D-Bus gives the error.
  std::string message() const {
    if (error_ == nullptr) return "unknown error";
    g_dbus_error_strip_remote_error(error_);
    return error_->message;
  }

 private:
  GError* error_ = nullptr;
};

}  // namespace mesher::app

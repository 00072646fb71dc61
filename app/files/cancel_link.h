#pragma once

#include <gio/gio.h>

namespace mesher::app {

/// Calls a function when, or if already, `source` is canceled, on the thread that cancels.
class CancelLink {
 public:
  CancelLink(GCancellable* source, void (*call)(GCancellable*, void*), void* data)
      : source_(source), id_(g_cancellable_connect(source, G_CALLBACK(call), data, nullptr)) {}
  ~CancelLink() { g_cancellable_disconnect(source_, id_); }
  CancelLink(const CancelLink&) = delete;
  CancelLink& operator=(const CancelLink&) = delete;

 private:
  GCancellable* source_;
  gulong id_;
};

}  // namespace mesher::app

#pragma once

#include <gio/gio.h>

#include <chrono>
#include <stdexcept>
#include <string>

#include "app/files/glib_handle.h"

namespace mesher::app {

/// The bus, or a program on it, is missing, does not answer, or answers with an error.
class BusError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns the D-Bus address of the session bus; empty if there is none. Reads
/// DBUS_SESSION_BUS_ADDRESS, or else looks for "bus" in XDG_RUNTIME_DIR. Leaves out addresses that
/// would start a bus ("autolaunch:").
std::string session_bus_address();

/// Returns a new connection to the bus. Its loss does not end the process. `stop`, or `limit` if it
/// passes first, ends the attempt. Throws BusError.
GlibHandle<GDBusConnection> connect_to_bus(const std::string& address, GCancellable* stop,
                                           std::chrono::milliseconds limit);

/// Sends what was not sent yet. Closes the connection if that takes longer than `limit`.
void flush(GDBusConnection* connection, std::chrono::milliseconds limit);

}  // namespace mesher::app

#pragma once

#include <sys/types.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/process.h"
#include "tests/support/temp_folder.h"

namespace mesher::test {

/// Sets or unsets (none) a variable of this process, until it is destroyed.
class Variable {
 public:
  Variable(const char* name, const std::optional<std::string>& value);
  ~Variable();
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  void set(const std::optional<std::string>& value) const;

  const char* name_;
  std::optional<std::string> before_;
};

/// Returns the Python that has dbusmock, if dbus-daemon is installed, too; empty otherwise.
const std::string& python_with_dbusmock();

/// A session bus of its own, which this process uses until the object is destroyed. Nothing else is
/// on it, and it starts nothing.
class MockBus {
 public:
  /// `answers`: if not, the bus takes connections and greetings, and answers none.
  explicit MockBus(bool answers = true);

  const TempFolder& folder() const { return folder_; }
  const std::string& address() const { return address_; }
  void kill() { daemon_->kill_at_once(); }
  /// Stops it as if it hung, or continues it.
  void freeze(bool on);

 private:
  TempFolder folder_;
  std::string address_;
  Variable variable_;
  std::unique_ptr<BackgroundProgram> daemon_;
};

/// A portal on a MockBus that answers as `parameters` say: see mock_portal.py.
class MockPortal {
 public:
  MockPortal(const MockBus& bus, nlohmann::json parameters);
  ~MockPortal() { freeze(false); }  // or it could not end
  MockPortal(const MockPortal&) = delete;
  MockPortal& operator=(const MockPortal&) = delete;

  /// Returns what happened so far.
  std::vector<nlohmann::json> events() const;
  /// Waits for the first event of this name. Null: it did not come within a minute.
  nlohmann::json wait_for(const std::string& name) const;
  void freeze(bool on);

 private:
  std::filesystem::path log_;
  std::unique_ptr<BackgroundProgram> program_;
  pid_t pid_ = -1;
};

}  // namespace mesher::test

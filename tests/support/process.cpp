#include "tests/support/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "tests/support/temp_folder.h"

namespace mesher::test {
namespace {

void apply(const std::vector<std::string>& environment) {
  for (const std::string& entry : environment) {
    const std::size_t equals = entry.find('=');
    if (equals == std::string::npos) {
      unsetenv(entry.c_str());
    } else {
      setenv(entry.substr(0, equals).c_str(), entry.substr(equals + 1).c_str(), 1);
    }
  }
}

[[noreturn]] void become(const std::vector<std::string>& arguments,
                         const std::vector<std::string>& environment) {
  // If the test dies, its programs must end as well, because they hold the pipe that the test's
  // runner reads.
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  apply(environment);
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) {
    pointers.push_back(const_cast<char*>(argument.c_str()));
  }
  pointers.push_back(nullptr);
  execvp(pointers[0], pointers.data());
  _exit(127);
}

int code_of(int status) {
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace

Finished run_program(const std::vector<std::string>& arguments,
                     const std::vector<std::string>& environment) {
  const TempFolder folder;
  const std::string out = folder / "out";
  const std::string err = folder / "err";
  const pid_t pid = fork();
  if (pid == 0) {
    dup2(open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    become(arguments, environment);
  }
  int status = 0;
  waitpid(pid, &status, 0);
  return {code_of(status), read_bytes(out), read_bytes(err)};
}

BackgroundProgram::BackgroundProgram(const std::vector<std::string>& arguments,
                                     const std::vector<std::string>& environment, int inherited_fd,
                                     const std::string& err)
    : pid_(fork()) {
  if (pid_ != 0) return;
  if (inherited_fd >= 0) fcntl(inherited_fd, F_SETFD, 0);
  if (!err.empty()) dup2(open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
  become(arguments, environment);
}

BackgroundProgram::~BackgroundProgram() {
  if (!is_running()) return;
  kill(pid_, SIGTERM);
  if (wait(5.0) == -1) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
}

void BackgroundProgram::send(int signal) {
  if (is_running()) kill(pid_, signal);
}

void BackgroundProgram::kill_at_once() {
  if (!is_running()) return;
  send(SIGKILL);
  wait(60.0);
}

bool BackgroundProgram::is_running() {
  if (exit_code_ != -1) return false;
  int status = 0;
  if (waitpid(pid_, &status, WNOHANG) == pid_) exit_code_ = code_of(status);
  return exit_code_ == -1;
}

int BackgroundProgram::wait(double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (is_running() && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return exit_code_;
}

}  // namespace mesher::test

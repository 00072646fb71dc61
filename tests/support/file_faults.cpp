#include "tests/support/file_faults.h"

#include "tests/support/sanitized.h"

namespace mesher::test {

std::vector<std::string> FileFaults::environment() const {
  std::vector<std::string> environment{"LD_PRELOAD=" MESHER_FILE_FAULTS,
                                       "FILE_FAULTS_AT=" + std::to_string(at)};
  // AddressSanitizer wants to be the first library, and is told that the second place will do.
  if (kSanitized) environment.emplace_back("ASAN_OPTIONS=verify_asan_link_order=0");
  if (has_no_tmpfile) environment.emplace_back("FILE_FAULTS_NO_TMPFILE=1");
  if (slow_us > 0) environment.push_back("FILE_FAULTS_SLOW_US=" + std::to_string(slow_us));
  if (signal > 0) environment.push_back("FILE_FAULTS_SIGNAL=" + std::to_string(signal));
  if (!cut.empty()) environment.push_back("FILE_FAULTS_CUT=" + cut);
  if (!change.empty()) environment.push_back("FILE_FAULTS_CHANGE=" + change);
  if (!log.empty()) environment.push_back("FILE_FAULTS_LOG=" + log);
  return environment;
}

}  // namespace mesher::test

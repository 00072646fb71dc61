# Writes the source that holds the commit: cmake -DSOURCE=... -DGIT=... -DOUTPUT=... -P commit.cmake
set(commit "")
if(GIT)
  # Only the repository whose top is this project, not one that this project lies in.
  execute_process(COMMAND ${GIT} rev-parse --short=7 HEAD WORKING_DIRECTORY ${SOURCE}
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE
    RESULT_VARIABLE failed ERROR_QUIET)
  execute_process(COMMAND ${GIT} rev-parse --show-prefix WORKING_DIRECTORY ${SOURCE}
    OUTPUT_VARIABLE prefix OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(failed OR NOT prefix STREQUAL "")
    set(commit "")
  endif()
endif()
if(commit STREQUAL "")
  # `git archive` replaces the contents of this file.
  file(STRINGS ${SOURCE}/cmake/commit.txt commit LIMIT_COUNT 1)
  if(NOT commit MATCHES "^[0-9a-f]+$")
    set(commit "")
  endif()
endif()
file(WRITE ${OUTPUT} "namespace mesher::app {
extern const char* const kCommit;
const char* const kCommit = \"${commit}\";
}  // namespace mesher::app
")

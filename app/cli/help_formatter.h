#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace mesher::app {

/// Formats --help for terminals of 80 columns: each option on a line, its text wrapped below it.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* command) const override;
};

}  // namespace mesher::app

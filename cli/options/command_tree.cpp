// SPDX-License-Identifier: Apache-2.0
#include "cli/options/command_tree.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>
#include <string_view>

namespace strake::cli {
namespace {

/// Returns the words of "hit|contact", and those of "[FILE=]x|y|z" that hold for all files; nothing
/// for a value that is not one of a few.
std::vector<std::string> words_of(const std::string& value) {
  constexpr std::string_view kOfOneFile = "[FILE=]";
  std::vector<std::string> words;
  std::istringstream text(value.starts_with(kOfOneFile) ? value.substr(kOfOneFile.size()) : value);
  for (std::string word; std::getline(text, word, '|');) words.push_back(word);
  const auto is_word = [](const std::string& word) {
    return !word.empty() && std::ranges::all_of(word, [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
  };
  if (words.size() < 2 || !std::ranges::all_of(words, is_word)) words.clear();
  return words;
}

OptionText text_of(const CLI::Option& option) {
  OptionText text;
  text.description = option.get_description();
  text.group = option.get_group();
  if (option.get_positional()) {
    text.names.push_back(option.get_name(true));
  } else {
    for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  }
  if (option.get_items_expected_max() > 0) text.value = option.get_type_name();
  text.words = words_of(text.value);
  text.takes_file = text.value == "FILE" || text.value == "OLD" || text.value == "NEW";
  text.takes_verb = text.value == "VERB";
  text.repeats = option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  return text;
}

/// Returns the command line as --help shows it, but without the word VERB.
std::string usage_of(const CLI::App& command, const CommandTree& tree) {
  std::string usage = "[OPTIONS]";
  for (const CLI::Option* option :
       command.get_options([](const CLI::Option* any) { return any->get_positional(); })) {
    const bool many = option->get_expected_max() >= CLI::detail::expected_max_vector_size;
    const std::string name = option->get_name(true) + (many ? "..." : "");
    usage += option->get_required() ? " " + name : " [" + name + "]";
  }
  if (!tree.verbs.empty()) usage += command.get_require_subcommand_min() == 0 ? " [VERB]" : " VERB";
  return usage;
}

}  // namespace

CommandTree command_tree(const CLI::App& program) {
  CommandTree tree;
  tree.name = program.get_name();
  tree.description = program.get_description();
  tree.footer = program.get_footer();
  const auto is_shown = [](const CLI::Option* option) { return !option->get_group().empty(); };
  for (const CLI::Option* option : program.get_options(is_shown))
    (option->get_positional() ? tree.arguments : tree.options).push_back(text_of(*option));
  for (const CLI::App* verb : program.get_subcommands([](const CLI::App*) { return true; }))
    tree.verbs.push_back(command_tree(*verb));
  tree.usage = usage_of(program, tree);
  return tree;
}

}  // namespace strake::cli

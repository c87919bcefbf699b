// SPDX-License-Identifier: Apache-2.0
#include "cli/command_tree.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

namespace strake::cli {
namespace {

/// "hit|contact" as its words; nothing of a value that is none of a few.
std::vector<std::string> words_of(const std::string& value) {
  std::vector<std::string> words;
  std::istringstream text(value);
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
  text.takes_file = text.value.find("FILE") != std::string::npos || option.get_positional();
  return text;
}

}  // namespace

CommandTree command_tree(const CLI::App& program) {
  CommandTree tree;
  tree.name = program.get_name();
  tree.description = program.get_description();
  tree.footer = program.get_footer();
  for (const CLI::Option* option : program.get_options())
    (option->get_positional() ? tree.arguments : tree.options).push_back(text_of(*option));
  for (const CLI::App* verb : program.get_subcommands([](const CLI::App*) { return true; }))
    tree.verbs.push_back(command_tree(*verb));
  tree.usage = tree.verbs.empty() || !tree.arguments.empty() ? "[OPTIONS]" : "VERB [OPTIONS]";
  for (const OptionText& argument : tree.arguments) tree.usage += " " + argument.names.front();
  return tree;
}

}  // namespace strake::cli

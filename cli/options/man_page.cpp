// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string_view>

#include "cli/options/command_tree.hpp"
#include "strake/core/version.hpp"

namespace strake::cli {
namespace {

/// Returns what troff prints as the ASCII character that it is, so that a reader may copy it to a
/// shell.
std::string as_typed(char c) {
  switch (c) {
    case '\\':
      return "\\e";
    case '-':
      return "\\-";
    case '\'':
      return "\\(aq";
    case '`':
      return "\\(ga";
    case '^':
      return "\\(ha";
    case '~':
      return "\\(ti";
    default:
      return {c};
  }
}

/// Returns text that troff prints unchanged: no escapes, no requests at the start of a line.
std::string plain(std::string_view text) {
  std::string out;
  bool starts_line = true;
  for (const char c : text) {
    if (starts_line && c == '.') out += "\\&";
    starts_line = c == '\n';
    out += as_typed(c);
  }
  return out;
}

void add_option(std::string& page, const OptionText& option) {
  page += ".TP\n";
  for (std::size_t i = 0; i < option.names.size(); ++i)
    page += (i > 0 ? ", \\fB" : "\\fB") + plain(option.names[i]) + "\\fR";
  if (!option.value.empty()) page += " \\fI" + plain(option.value) + "\\fR";
  page += "\n" + plain(option.description) + "\n";
}

/// Adds options in their groups, in the order of the first of each.
void add_options(std::string& page, const std::vector<OptionText>& options) {
  std::vector<std::string> groups;
  for (const OptionText& option : options)
    if (!option.group.empty() && std::ranges::find(groups, option.group) == groups.end())
      groups.push_back(option.group);
  for (const std::string& group : groups) {
    page += ".SS " + plain(group) + "\n";
    for (const OptionText& option : options)
      if (option.group == group) add_option(page, option);
  }
}

/// Returns "strake clash diff" as the name of its page.
std::string page_name(std::string path) {
  std::ranges::replace(path, ' ', '-');
  return path;
}

}  // namespace

std::string man_page(const CommandTree& command, const std::string& path) {
  std::string title = page_name(path);
  std::ranges::transform(title, title.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  std::string page = ".TH " + plain(title) + " 1 \"\" \"strake " + std::string(version()) +
                     "\" \"Strake manual\"\n.SH NAME\n" + plain(page_name(path)) + " \\- " +
                     plain(command.description) + "\n.SH SYNOPSIS\n\\fB" + plain(path) + "\\fR " +
                     plain(command.usage) + "\n";
  if (!command.arguments.empty()) {
    page += ".SH ARGUMENTS\n";
    for (const OptionText& argument : command.arguments) add_option(page, argument);
  }
  page += ".SH OPTIONS\n";
  add_options(page, command.options);
  if (!command.verbs.empty()) {
    page += ".SH VERBS\n";
    for (const CommandTree& verb : command.verbs)
      page += ".TP\n\\fB" + plain(page_name(path + " " + verb.name)) + "\\fR(1)\n" +
              plain(verb.description) + "\n";
  }
  if (!command.footer.empty())
    page += ".SH NOTES\n.nf\n" +
            plain(command.footer.substr(command.footer.find_first_not_of('\n'))) + "\n.fi\n";
  return page;
}

}  // namespace strake::cli

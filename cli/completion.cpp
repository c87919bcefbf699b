// SPDX-License-Identifier: Apache-2.0
#include <functional>

#include "cli/command_tree.hpp"

namespace strake::cli {
namespace {

/// A command with the words that lead to it, each after a space: " clash diff"; none to the
/// program.
using Visit = std::function<void(const CommandTree&, const std::string& path)>;

void walk(const CommandTree& command, const std::string& path, const Visit& visit) {
  visit(command, path);
  for (const CommandTree& verb : command.verbs) walk(verb, path + " " + verb.name, visit);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// In single quotes of a shell.
std::string quoted(const std::string& text, const std::string& quote_within) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'')
      out += quote_within;
    else
      out += c;
  }
  return out + "'";
}

}  // namespace

std::string bash_completion(const CommandTree& program) {
  std::string verbs, values, words;
  walk(program, "", [&](const CommandTree& command, const std::string& path) {
    std::string all;
    for (const CommandTree& verb : command.verbs) {
      verbs += (verbs.empty() ? "" : "|") + ("'" + path + " " + verb.name + "'");
      all += verb.name + " ";
    }
    for (const OptionText& argument : command.arguments)
      if (!argument.words.empty()) all += joined(argument.words) + " ";
    for (const OptionText& option : command.options) {
      all += joined(option.names) + " ";
      if (option.value.empty()) continue;
      std::string cases;
      for (const std::string& name : option.names)
        cases += (cases.empty() ? "" : "|") + ("'" + path + ":" + name + "'");
      const std::string reply = !option.words.empty()
                                    ? "compgen -W '" + joined(option.words) + "' -- \"$current\""
                                : option.takes_file ? "compgen -f -- \"$current\""
                                                    : "true";
      values += "    " + cases + ") mapfile -t COMPREPLY < <(" + reply + "); return ;;\n";
    }
    words += "    '" + path + "') words='" + all + "' ;;\n";
  });
  return "# bash completion of strake, made from its --help\n"
         "_strake() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} path= words= word\n"
         "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
         "    case \"$path $word\" in\n"
         "    " +
         verbs +
         ") path+=\" $word\" ;;\n"
         "    esac\n"
         "  done\n"
         "  case \"$path:${COMP_WORDS[COMP_CWORD-1]}\" in\n" +
         values +
         "  esac\n"
         "  case \"$path\" in\n" +
         words +
         "  esac\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
         "  [[ $current == -* ]] || mapfile -t -O \"${#COMPREPLY[@]}\" COMPREPLY < <(compgen -f -- "
         "\"$current\")\n"
         "}\n"
         "complete -o filenames -F _strake strake\n";
}

std::string zsh_completion(const CommandTree& program) {
  return "#compdef strake\nautoload -U +X bashcompinit && bashcompinit\n" +
         bash_completion(program);
}

std::string fish_completion(const CommandTree& program) {
  std::string text = "# fish completion of strake, made from its --help\n";
  walk(program, "", [&](const CommandTree& command, const std::string& path) {
    // Seen all of the words that lead to the command, and none that leads on.
    std::string seen;
    for (std::size_t from = 1; from < path.size();) {
      const std::size_t to = std::min(path.find(' ', from), path.size());
      seen += "__fish_seen_subcommand_from " + path.substr(from, to - from) + "; and ";
      from = to + 1;
    }
    std::vector<std::string> further;
    for (const CommandTree& verb : command.verbs) further.push_back(verb.name);
    seen += further.empty() ? "true" : "not __fish_seen_subcommand_from " + joined(further);
    const std::string start = "complete -c strake -n '" + seen + "'";
    for (const CommandTree& verb : command.verbs)
      text += start + " -a " + verb.name + " -d " + quoted(verb.description, "\\'") + "\n";
    for (const OptionText& argument : command.arguments)
      if (!argument.words.empty()) text += start + " -f -a '" + joined(argument.words) + "'\n";
    for (const OptionText& option : command.options) {
      text += start;
      for (const std::string& name : option.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!option.words.empty())
        text += " -x -a '" + joined(option.words) + "'";
      else if (option.takes_file)
        text += " -r -F";
      else if (!option.value.empty())
        text += " -x";
      text += " -d " + quoted(option.description, "\\'") + "\n";
    }
  });
  return text;
}

}  // namespace strake::cli

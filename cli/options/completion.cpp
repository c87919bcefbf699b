// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>
#include <string_view>

#include "cli/options/command_tree.hpp"

namespace strake::cli {
namespace {

/// A visitor of a command with the words that lead to it, each after a space: " clash diff"; none
/// for the program.
using Visit = std::function<void(const CommandTree&, const std::string& path)>;

void walk(const CommandTree& command, const std::string& path, const Visit& visit) {
  visit(command, path);
  for (const CommandTree& verb : command.verbs) walk(verb, path + " " + verb.name, visit);
}

/// Returns verbs as mere words behind `taker`, whose options may come among them.
std::vector<CommandTree> as_words(const std::vector<CommandTree>& verbs, const CommandTree& taker) {
  std::vector<CommandTree> words;
  for (const CommandTree& verb : verbs) {
    CommandTree& word = words.emplace_back();
    word.name = verb.name;
    word.description = verb.description;
    word.options = taker.options;
    word.verbs = as_words(verb.verbs, taker);
  }
  return words;
}

/// Returns the program as it is typed: `man` is followed by the words of any verb.
CommandTree typed(const CommandTree& program) {
  CommandTree tree = program;
  for (CommandTree& verb : tree.verbs)
    if (std::ranges::any_of(verb.arguments, &OptionText::takes_verb))
      verb.verbs = as_words(program.verbs, verb);
  return tree;
}

std::string joined(const std::vector<std::string>& words, std::string_view between = " ") {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += between;
    text += word;
  }
  return text;
}

/// Puts a text in single quotes of a shell, which writes a quote within them as `quote`.
std::string quoted(const std::string& text, std::string_view quote = "'\\''") {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'')
      out += quote;
    else
      out += c;
  }
  return out + "'";
}

bool takes_files(const CommandTree& command) {
  return std::ranges::any_of(command.arguments, &OptionText::takes_file);
}

/// Returns the words that may come where no option does, except verbs.
std::vector<std::string> argument_words(const CommandTree& command) {
  std::vector<std::string> words;
  for (const OptionText& argument : command.arguments)
    words.insert(words.end(), argument.words.begin(), argument.words.end());
  return words;
}

/// What words mean behind the verbs of a path, each as 'path:word'. A shell reads a command line
/// from its start by these, so that a value with the name of a verb leads nowhere.
struct Meanings {
  std::vector<std::string> verbs;     ///< words that lead to the next command
  std::vector<std::string> valued;    ///< options whose value is the next word
  std::vector<std::string> to_files;  ///< those of them whose value is a file
  std::vector<std::string> files;     ///< no words but paths: commands that take files
};

Meanings meanings(const CommandTree& program) {
  Meanings all;
  walk(program, "", [&](const CommandTree& command, const std::string& path) {
    for (const CommandTree& verb : command.verbs)
      all.verbs.push_back(quoted(path + ":" + verb.name));
    for (const OptionText& option : command.options)
      for (const std::string& name : option.names) {
        if (!option.value.empty()) all.valued.push_back(quoted(path + ":" + name));
        if (option.takes_file) all.to_files.push_back(quoted(path + ":" + name));
      }
    if (takes_files(command)) all.files.push_back(quoted(path));
  });
  return all;
}

// Bash: arrays without mapfile, which bash 3 of macOS lacks.
constexpr std::string_view kBashHead = R"(# bash completion of strake, made from its --help
_strake_offer() {
  local line
  while IFS= read -r line; do COMPREPLY+=("$line"); done < <(compgen "$@")
}
_strake_offer_files() {
  compopt -o filenames 2>/dev/null
  _strake_offer -f -P "$prefix" -- "$current"
}
_strake() {
  local current=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD-1]}
  local prefix= verbs= awaits= word words= options= files=
  COMPREPLY=()
  # Of --option=value bash makes three words, unless COMP_WORDBREAKS lacks the =.
  if [[ $current == = ]]; then
    current=
  elif [[ $option == = ]]; then
    option=${COMP_WORDS[COMP_CWORD-2]}
  elif [[ $current == --*=* ]]; then
    option=${current%%=*} prefix=${current%%=*}= current=${current#*=}
  fi
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    [[ $word == = ]] && continue
    if [[ $awaits ]]; then awaits=; continue; fi
    case "$verbs:$word" in
)";
constexpr std::string_view kBashTail = R"(  esac
  if [[ $current == -* ]]; then
    _strake_offer -W "$options" -- "$current"
  else
    _strake_offer -W "$words" -- "$current"
    [[ ! $files ]] || _strake_offer_files
  fi
}
if type compopt >/dev/null 2>&1; then
  complete -F _strake strake
else
  complete -o filenames -F _strake strake
fi
)";

/// Returns the cases of options whose value is one of a few words.
std::string bash_values(const CommandTree& program) {
  std::string cases;
  walk(program, "", [&](const CommandTree& command, const std::string& path) {
    for (const OptionText& option : command.options) {
      if (option.words.empty()) continue;
      std::vector<std::string> names;
      for (const std::string& name : option.names) names.push_back(quoted(path + ":" + name));
      cases += "      " + joined(names, "|") + ") _strake_offer -W '" + joined(option.words) +
               "' -P \"$prefix\" -- \"$current\" ;;\n";
    }
  });
  return cases;
}

/// Returns the cases of what may come behind the verbs of each command.
std::string bash_words(const CommandTree& program) {
  std::string cases;
  walk(program, "", [&](const CommandTree& command, const std::string& path) {
    std::vector<std::string> words = argument_words(command), options;
    for (const CommandTree& verb : command.verbs) words.push_back(verb.name);
    for (const OptionText& option : command.options)
      options.insert(options.end(), option.names.begin(), option.names.end());
    cases += "    " + quoted(path) + ") words='" + joined(words) + "' options='" + joined(options) +
             "'" + (takes_files(command) ? " files=1" : "") + " ;;\n";
  });
  return cases;
}

/// Returns text for a specification of zsh's _arguments.
std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

/// Returns an option as specifications of _arguments, one for each of its names.
std::string zsh_option(const OptionText& option) {
  std::string value;
  if (!option.value.empty())
    value = ":" + zsh_text(option.value) + ":" +
            (!option.words.empty() ? "(" + joined(option.words) + ")"
             : option.takes_file   ? "_files"
                                   : " ");
  std::string text;
  for (const std::string& name : option.names) {
    const std::string start = option.repeats            ? "*"
                              : option.names.size() > 1 ? "(" + joined(option.names) + ")"
                                                        : "";
    const std::string behind = value.empty() ? "" : name.starts_with("--") ? "=" : "+";
    text += " \\\n        " +
            quoted(start + name + behind + "[" + zsh_text(option.description) + "]" + value);
  }
  return text;
}

/// Returns the cases of what may come where no option does.
std::string zsh_operands(const CommandTree& program) {
  std::string cases;
  walk(program, "", [&](const CommandTree& command, const std::string& path) {
    std::vector<std::string> words;
    for (const std::string& word : argument_words(command)) words.push_back(quoted(word));
    for (const CommandTree& verb : command.verbs)
      words.push_back(quoted(verb.name + ":" + verb.description));
    if (!words.empty())
      cases += "    " + quoted(path) + ")\n      operands=(\n        " +
               joined(words, "\n        ") + ") ;;\n";
  });
  return cases;
}

/// Returns the cases that let _arguments complete the rest.
std::string zsh_commands(const CommandTree& program) {
  std::string cases;
  walk(program, "", [&](const CommandTree& command, const std::string& path) {
    cases += "    " + quoted(path) + ")\n      _arguments -s -S";
    for (const OptionText& option : command.options) cases += zsh_option(option);
    cases += " \\\n        '*: :_strake_operands' ;;\n";
  });
  return cases;
}

/// Returns an option as the end of a line that describes it to fish.
std::string fish_option(const OptionText& option) {
  std::string text;
  for (const std::string& name : option.names)
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!option.words.empty())
    text += " -x -a '" + joined(option.words) + "'";
  else if (option.takes_file)
    text += " -r -F";
  else if (!option.value.empty())
    text += " -x";
  return text + " -d " + quoted(option.description, "\\'") + "\n";
}

std::string fish_commands(const CommandTree& program) {
  std::string text;
  walk(program, "", [&](const CommandTree& command, const std::string& path) {
    const std::string start = "complete -c strake -n \"__strake_at '" + path + "'\"";
    for (const CommandTree& verb : command.verbs)
      text += start + " -a " + verb.name + " -d " + quoted(verb.description, "\\'") + "\n";
    if (const auto words = argument_words(command); !words.empty())
      text += start + " -a '" + joined(words) + "'\n";
    if (takes_files(command)) text += start + " -F\n";
    for (const OptionText& option : command.options) text += start + fish_option(option);
  });
  return text;
}

}  // namespace

std::string bash_completion(const CommandTree& program) {
  const CommandTree tree = typed(program);
  const Meanings all = meanings(tree);
  return std::string(kBashHead) + "      " + joined(all.verbs, "|") +
         ") verbs+=\" $word\" ;;\n"
         "      " +
         joined(all.valued, "|") +
         ") awaits=1 ;;\n"
         "    esac\n"
         "  done\n"
         "  if [[ $awaits || $prefix ]]; then\n"
         "    case \"$verbs:$option\" in\n" +
         bash_values(tree) + "      " + joined(all.to_files, "|") +
         ") _strake_offer_files ;;\n"
         "    esac\n"
         "    return\n"
         "  fi\n"
         "  case \"$verbs\" in\n" +
         bash_words(tree) + std::string(kBashTail);
}

std::string zsh_completion(const CommandTree& program) {
  const CommandTree tree = typed(program);
  const Meanings all = meanings(tree);
  return "#compdef strake\n"
         "# zsh completion of strake, made from its --help\n"
         "_strake_operands() {\n"
         "  local found=1\n"
         "  local -a operands\n"
         "  case $strake_verbs in\n" +
         zsh_operands(tree) +
         "  esac\n"
         "  (( $#operands )) && _describe -t verbs verb operands && found=0\n"
         "  case $strake_verbs in\n"
         "    " +
         joined(all.files, "|") +
         ") _files && found=0 ;;\n"
         "  esac\n"
         "  return found\n"
         "}\n"
         "_strake() {\n"
         "  local strake_verbs= awaits= word\n"
         "  local -i i at=1\n"
         "  for (( i = 2; i < CURRENT; ++i )); do\n"
         "    word=$words[i]\n"
         "    if [[ -n $awaits ]]; then awaits=; continue; fi\n"
         "    case \"$strake_verbs:$word\" in\n"
         "      " +
         joined(all.verbs, "|") +
         ") strake_verbs+=\" $word\"; at=i ;;\n"
         "      " +
         joined(all.valued, "|") +
         ") awaits=1 ;;\n"
         "    esac\n"
         "  done\n"
         "  words=(\"${(@)words[at,-1]}\")\n"
         "  (( CURRENT -= at - 1 ))\n"
         "  case $strake_verbs in\n" +
         zsh_commands(tree) +
         "  esac\n"
         "}\n"
         "# The first TAB runs this file as the function; `source` only tells of it.\n"
         "if [[ $funcstack[1] == _strake ]]; then _strake \"$@\"; else compdef _strake strake; "
         "fi\n";
}

std::string fish_completion(const CommandTree& program) {
  const CommandTree tree = typed(program);
  const Meanings all = meanings(tree);
  return "# fish completion of strake, made from its --help\n"
         "function __strake_at\n"
         "  set -l verbs ''\n"
         "  set -l awaits ''\n"
         "  set -l typed (commandline -opc)\n"
         "  set -e typed[1]\n"
         "  for word in $typed\n"
         "    if test -n \"$awaits\"\n"
         "      set awaits ''\n"
         "      continue\n"
         "    end\n"
         "    switch \"$verbs:$word\"\n"
         "      case " +
         joined(all.verbs) +
         "\n        set verbs \"$verbs $word\"\n"
         "      case " +
         joined(all.valued) +
         "\n        set awaits 1\n"
         "    end\n"
         "  end\n"
         "  test \"$verbs\" = \"$argv[1]\"\n"
         "end\n"
         "complete -c strake -f\n" +
         fish_commands(tree);
}

}  // namespace strake::cli

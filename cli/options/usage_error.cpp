// SPDX-License-Identifier: Apache-2.0
#include "cli/options/usage_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "cli/options/nearest_word.hpp"

namespace strake::cli {

namespace {

Error usage(std::string message, std::string mend) {
  return {ErrorCode::usage, std::move(message), {}, std::move(mend)};
}

std::vector<const CLI::App*> verbs_of(const CLI::App& command) {
  return command.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> names_of_verbs(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* verb : verbs_of(command)) names.push_back(verb->get_name());
  return names;
}

std::vector<std::string> names_of_options(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string verbs_there_are(const CLI::App& command) {
  std::string list;
  for (const std::string& name : names_of_verbs(command)) list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "it has no verbs" : "the verbs are " + list;
}

Error unknown_verb(const FoundCommand& at, const std::string& word) {
  const bool outermost = at.path.find(' ') == std::string::npos;
  return usage(outermost ? "there is no verb '" + word + "'"
                         : "'" + at.path + "' has no verb '" + word + "'",
               did_you_mean(word, names_of_verbs(*at.command), verbs_there_are(*at.command)));
}

/// What is wrong with a word that no option and no argument took.
Error unknown_word(const FoundCommand& at, const std::string& word) {
  const std::string help = "'" + at.path + " --help' tells what there is";
  if (!word.starts_with('-') || word == "-")
    return usage("'" + word + "' is one word too many", "leave it out; " + help);
  const std::string name = word.substr(0, word.find('='));
  const std::string mend = did_you_mean(name, names_of_options(*at.command), {});
  return usage("there is no option '" + name + "'", mend.empty() ? help : mend + " " + help);
}

/// A verb of some is wanted.
Error no_verb(const FoundCommand& at, const std::vector<std::string>& strange) {
  if (strange.empty()) return usage("no verb is given", verbs_there_are(*at.command));
  const std::string& word = strange.front();
  if (!word.starts_with('-')) return unknown_verb(at, word);
  return usage("no verb is given before '" + word + "'",
               verbs_there_are(*at.command) + "; options stand behind them");
}

/// What must be given is missing: `name` is of an option or of an argument.
Error missing(const FoundCommand& at, const std::string& name) {
  const std::string help = "'" + at.path + " --help' tells what there is";
  const CLI::Option* const option = at.command->get_option_no_throw(name);
  if (option == nullptr) return usage(name + " is not given", help);
  const std::string type = option->get_type_name();
  if (option->get_positional())
    return usage(type + " is not given: " + option->get_description(), help);
  return usage(name + " is not given", "write " + name + " " + type + "; " + help);
}

}  // namespace

Error usage_error(const CLI::App& program, const CLI::ParseError& error) {
  FoundCommand at{&program, program.get_name()};
  for (auto used = program.get_subcommands(); !used.empty(); used = at.command->get_subcommands())
    at = {used.front(), at.path + " " + used.front()->get_name()};
  // What is left over is reported under the name of its verb, not of the error.
  const bool left_over = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  const std::string message = error.what(), kind = error.get_name();
  const std::string help = "'" + at.path + " --help' tells what there is";
  const std::vector<std::string> strange = at.command->remaining(), before = program.remaining();
  if (at.command->get_require_subcommand_min() > 0) return no_verb(at, strange);
  if (left_over && !strange.empty()) return unknown_word(at, strange.front());
  if (left_over && !before.empty())
    return usage("'" + before.front() + "' stands before the verb", "options stand behind it");
  const std::string option = message.substr(0, message.find(": "));
  if (kind == "RequiredError") {
    if (message.starts_with("files")) return usage("no model file is given", help);
    return missing(at, message.substr(0, message.find(' ')));
  }
  if (kind == "ArgumentMismatch" && option != message)
    return message.find("missing") != std::string::npos
               ? usage(option + " wants a value", help)
               : usage(option + " is given more than once", "give it once; " + help);
  if (kind == "ExcludesError") return usage(message, "leave one of them out; " + help);
  if (kind == "RequiresError")
    return usage(message, "add " + message.substr(message.rfind(' ') + 1) + "; " + help);
  constexpr std::string_view kNotConverted = "Could not convert: ";
  if (kind == "ConversionError" && message.starts_with(kNotConverted))
    return usage(message.substr(kNotConverted.size(),
                                message.find(' ', kNotConverted.size()) - kNotConverted.size()) +
                     " takes no value",
                 "leave out '=' and what follows");
  return usage(message, help);
}

Result<FoundCommand> find_command(const CLI::App& program, const std::vector<std::string>& verbs) {
  FoundCommand at{&program, program.get_name()};
  for (const std::string& word : verbs) {
    const std::vector<const CLI::App*> known = verbs_of(*at.command);
    const auto found =
        std::ranges::find(known, word, [](const CLI::App* verb) { return verb->get_name(); });
    if (found == known.end()) return unknown_verb(at, word);
    at = {*found, at.path + " " + word};
  }
  return at;
}

}  // namespace strake::cli

// SPDX-License-Identifier: Apache-2.0
#include "sheets/references.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace strake::sheets {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// Elements that are drawn, each as often as it is: far more than a frame and a title block have,
/// and in proportion to what the template holds.
constexpr std::uint64_t kMostDrawn = 100000, kMostTimes = 10;

Error fault(std::size_t line, std::string message, std::string mend) {
  return {ErrorCode::input, std::move(message), "line " + std::to_string(line), std::move(mend)};
}

}  // namespace

std::vector<std::string> url_targets(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  constexpr std::string_view kUrl = "url(";
  std::vector<std::string> targets;
  for (std::size_t at = lower.find(kUrl); at != std::string::npos; at = lower.find(kUrl, at)) {
    at += kUrl.size();
    at = std::min(lower.find_first_not_of(' ', at), lower.size());
    const bool quoted = at < lower.size() && (lower[at] == '\'' || lower[at] == '"');
    const std::string_view last = quoted ? std::string_view(lower).substr(at, 1) : " )";
    if (quoted) at = std::min(lower.find_first_not_of(' ', at + 1), lower.size());
    if (at == lower.size() || lower[at] != '#') continue;
    const std::size_t end = std::min(lower.find_first_of(last, at), lower.size());
    targets.emplace_back(text.substr(at + 1, end - at - 1));
  }
  return targets;
}

void References::open(std::string_view name, std::string_view id) {
  const auto element = static_cast<std::uint32_t>(elements_.size());
  if (!open_.empty()) elements_[open_.back()].children.push_back(element);
  open_.push_back(element);
  elements_.push_back(
      {std::string(id), name == "linearGradient" || name == "radialGradient", {}, {}});
}

void References::refer(std::string target, std::size_t line) {
  elements_[open_.back()].references.push_back({std::move(target), line});
}

void References::refer_in_style(std::string target, std::size_t line) {
  in_style_.push_back({std::move(target), line});
}

/// Counts what is drawn, element by element, each as often as it is referred to. On a stack of its
/// own: references lead deeper than elements are nested.
class References::Walk {
 public:
  explicit Walk(const std::vector<Element>& elements)
      : elements_(elements), drawn_(elements.size(), kUnknown) {
    for (std::uint32_t e = 0; e < elements.size(); ++e)
      if (!elements[e].id.empty()) by_id_.emplace(elements[e].id, e);
    most_ = kMostDrawn + kMostTimes * elements.size();
  }

  [[nodiscard]] Status run() {
    if (!elements_.empty()) enter(0);
    while (!path_.empty()) {
      if (const Status status = step(); !status) return status;
    }
    return {};
  }

  /// kNone where there is no such element: then nothing is drawn. An error where programs would not
  /// agree which one it is.
  [[nodiscard]] Result<std::uint32_t> find(const Reference& reference) const {
    const std::string& id = reference.target;
    // By its number a letter can spell the name of another element, and programs take blanks off.
    if (const std::size_t at = id.find_first_of("% "); at != std::string::npos)
      return fault(reference.line,
                   std::string(id[at] == '%' ? "'%' stands" : "a blank stands") +
                       " in the reference '#" + id + "'",
                   "give the element a name of letters and digits");
    if (by_id_.count(id) > 1)
      return fault(reference.line,
                   "'#" + id + "' is referred to, but several elements have that id",
                   "give each its own");
    const auto at = by_id_.find(id);
    return at == by_id_.end() ? kNone : at->second;
  }

 private:
  static constexpr std::uint64_t kUnknown = std::numeric_limits<std::uint64_t>::max();
  static constexpr std::uint64_t kOpen = kUnknown - 1;

  struct Step {
    std::uint32_t element = 0;
    std::size_t next = 0;  ///< of its children, then of its references
    std::uint64_t drawn = 1;
  };

  void enter(std::uint32_t element) {
    drawn_[element] = kOpen;
    path_.push_back({element, 0, 1});
  }

  [[nodiscard]] Status step() {
    Step& at = path_.back();
    const Element& element = elements_[at.element];
    if (at.next == element.children.size() + element.references.size()) {
      drawn_[at.element] = at.drawn;
      path_.pop_back();
      return {};
    }
    const bool child = at.next < element.children.size();
    const Reference* const reference =
        child ? nullptr : &element.references[at.next - element.children.size()];
    const Result<std::uint32_t> found = child ? element.children[at.next] : find(*reference);
    if (!found) return found.error();
    const std::uint32_t to = *found;
    if (to != kNone && drawn_[to] == kUnknown) {
      enter(to);
      return {};
    }
    ++at.next;
    if (to == kNone) return {};
    if (drawn_[to] == kOpen) return circle(*reference);
    at.drawn += drawn_[to];
    return at.drawn > most_ ? too_much(element, reference) : Status();
  }

  [[nodiscard]] static Status circle(const Reference& reference) {
    return fault(reference.line, "'#" + reference.target + "' is drawn within itself",
                 "take the reference out, or let it lead to something else");
  }

  [[nodiscard]] Status too_much(const Element& element, const Reference* reference) const {
    if (reference == nullptr)  // its children draw that much: one of them refers
      for (const std::uint32_t child : element.children)
        if (!elements_[child].references.empty()) reference = &elements_[child].references.front();
    return fault(reference == nullptr ? 1 : reference->line,
                 "the references draw more than " + std::to_string(most_) + " elements",
                 "refer to less, or less often: what is drawn by reference counts each time");
  }

  const std::vector<Element>& elements_;
  std::multimap<std::string_view, std::uint32_t> by_id_;
  std::vector<std::uint64_t> drawn_;  ///< per element, itself included
  std::uint64_t most_ = 0;
  std::vector<Step> path_;
};

Status References::check() const {
  Walk walk(elements_);
  for (const Reference& reference : in_style_) {
    const Result<std::uint32_t> target = walk.find(reference);
    if (!target) return target.error();
    if (*target != kNone && !elements_[*target].is_gradient)
      return fault(reference.line,
                   "'url(#" + reference.target + ")' has no place in the style of a template",
                   "write it as an attribute of the elements that it is for: fill=\"url(#" +
                       reference.target + ")\"");
  }
  return walk.run();
}

}  // namespace strake::sheets

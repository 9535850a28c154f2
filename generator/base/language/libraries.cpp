// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/language/libraries.hpp"

#include <fmt/args.h>

#include <array>
#include <optional>
#include <vector>

#include "base/language/say.hpp"

namespace alembert {

namespace {

constexpr std::array patterns{
    // The runtime. What is more special stands first.
    to_say("{} right-hand sides were not enough to come further than t = {}, with {} impacts and changes of "
           "contact{}; "
           "raise the budget, loosen the tolerance or shorten the duration"),
    to_say("{} right-hand sides were not enough to come further than t = {}; raise the budget, loosen the "
           "tolerance or "
           "shorten the duration"),
    to_say("step size underflow at t = {} (step {}): {} is the stiffest component, its error was {} times the "
           "tolerance; there may be a singularity here, or the tolerance is beyond double precision"),
    to_say("step size underflow at t = {} (step {}): {} or its rate is not finite, however short the step; there "
           "is a "
           "singularity here"),
    to_say("step size underflow at t = {}; there may be a singularity here, or the tolerance is beyond double "
           "precision"),
    to_say("the regularized run found no step after t = {}, where the potential energy is {}: it has to stay "
           "negative, and steps short enough for their equations; take a shorter step, or no regularization"),
    to_say("{} is no longer finite after t = {}; take a shorter step, or an adaptive method such as dop853"),
    to_say(
        "the equations of {} could not be solved for the step after t = {}; take a shorter step, or radau for a "
        "stiff system"),
    to_say(
        "the rate of {} is not finite at the start, t = {}; look at its equation, and at the initial values and "
        "parameters"),
    to_say("the signs of {} and {} others change together at t = {}, more than {} at once"),
    to_say("the sign of {} changes without end at t = {}: no side of it is consistent"),
    to_say(
        "at t = {} the sign of {} has no consistent side: the equations have no motion that goes on from there"),
    to_say(
        "at t = {} the motion may go on to either side of {} = 0: the equations do not say which; start close to "
        "that state instead"),
    to_say("no contact mode is consistent at t = {} with the contacts {} closed: {}"),
    to_say("more than one contact mode is consistent at t = {}, with different accelerations: {}"),
    to_say(
        "no contact mode is consistent at t = {}: contact '{}' and others open and close while the time does not "
        "advance; loosen the tolerance, or look at the gaps there"),
    to_say("event '{}' and others at t = {} set states that turn its value back and forth at its zero without "
           "end; what "
           "slides along a zero is a force with sign(…), or a [[friction]]"),
    to_say("the impulses of event '{}' follow each other without end before t = {}: the last {} came within {} s; "
           "what bounces and comes to rest is a [[unilateral]] with its restitution; an impulse that is not to "
           "follow itself needs a 'direction' or another 'when'"),
    to_say("there are no rates after the impulses of the events at t = {}: {}"),
    to_say("a value is not finite"),
    to_say("the mass matrix is singular"),
    to_say("the constraints contradict each other"),
    to_say("a contact closes at a speed that the constraints prescribe"),
    to_say("no rates keep all contacts apart"),
    to_say("the collisions at one instant do not come to an end"),
    to_say("the constraints prescribe that a contact closes"),
    to_say("no accelerations keep all contacts apart"),
    to_say("friction makes the contact force grow without bound during the impact"),
    to_say("an impact can be computed where each contact has one friction only"),
    to_say("simultaneous impacts with friction can be computed where each contact has one friction, without a "
           "restitution of its own"),
    to_say("no choice of sticking and sliding is consistent in their impact together"),
    to_say("the impulses of their impact together do not settle, so that it is not known which result it has; "
           "smaller coefficients of friction, or contacts that strike one after the other, may have one"),
    to_say(
        "several choices of sticking and sliding are consistent in their impact together, and the motion after it "
        "depends on the order in which they strike"),
    to_say("their impact together would gain energy with these restitutions and coefficients"),
    to_say(
        "no C++ compiler: looked for {} in $PATH; install one (on Debian: apt install g++) or name one with $CXX"),
    to_say("cannot write {}: {}; is the disk full?"),
    to_say("cannot write to the cache, nor make a temporary folder {}: {}; name a writable folder with "
           "$XDG_CACHE_HOME or $TMPDIR"),
    to_say("the cache of compiled solvers, {}, belongs to user {} and has mode {}; expected user {} and no right "
           "for others to write, because what is in it is run: chmod go-w it if it is yours, or name another "
           "folder with $XDG_CACHE_HOME"),
    to_say("the compiler failed with status {}:\n  {}\n{}"),
    to_say("the compiler succeeded but left no {}"),
    to_say("cannot rename {} to {}: {}"),
    to_say("cannot load the solver: {}; delete it from the cache, and see that the folder allows programs to run"),
    to_say("{} was emitted for version {} of the solver ABI, this program has version {}; emit it again"),
    to_say("{} was emitted for version {} of the series' ABI, this program has version {}; emit it again"),
    to_say("{} is not a solver: it has no alembert_solver()"),
    to_say("{} holds no Taylor series: it has no alembert_series()"),
    to_say("cannot make a pipe to a child process: {}"),
    to_say("cannot start {}: {}"),
    to_say("a function whose sign is needed is not a number at t = {}"),
    to_say("{} has a fixed step: give it, for example step = {}"),
    to_say("step = {}: more than {} steps"),
    to_say("longest_step (max_step of a scene) = {}: more than {} steps"),
    to_say("{}={}: expected a finite number"),
    to_say("{}={}: expected a number above zero"),
    to_say("{}={}: expected a number of zero or more"),
    to_say("{}={}: expected a whole number above zero"),
    to_say("{}={}: expected a whole number of zero or more"),
    to_say("sample = {}: more than {} rows"),
};

/// toml++, and the words that it puts into its messages.
constexpr std::array toml_patterns{
    to_say("expected comma or closing '{}', saw {}"),
    to_say("expected value or closing '{}', saw {}"),
    to_say("expected key-value pair or closing '{}', saw {}"),
    to_say("expected keys, tables, whitespace or comments, saw {}"),
    to_say("expected bare key starting character or string delimiter, saw {}"),
    to_say("expected a comment or whitespace, saw {}"),
    to_say("expected hex digit, saw {}"),
    to_say("expected '{}', saw {}"),
    to_say("expected second between {} and {} (inclusive), saw {}"),
    to_say("expected {} between {} and {} (inclusive), saw {}"),
    to_say("expected {} between {} to {} (inclusive), saw {}"),
    to_say("unknown escape sequence '{}'"),
    to_say("unicode surrogates (U+D800 - U+DFFF) are explicitly prohibited"),
    to_say("values greater than U+10FFFF are invalid"),
    to_say("cannot redefine existing {} '{}' as {}"),
    to_say("cannot redefine existing {} as {}"),
    to_say("cannot redefine existing {} '{}'"),
    to_say("underscores may only follow digits"),
    to_say("values may not begin with underscores"),
    to_say("could not determine value type"),
    to_say("multi-line strings are prohibited in keys"),
    to_say("line-ending backslashes must be the last non-whitespace character on the line"),
    to_say("dotted key-value pair"),
    to_say("array-of-tables"),
    to_say("array"),
    to_say("table"),
    to_say("integer"),
    to_say("string"),
    to_say("boolean"),
    to_say("floating-point"),
    to_say("year"),
    to_say("month"),
    to_say("day"),
    to_say("hour"),
    to_say("minute"),
    to_say("comma"),
};

/// What stands at the places {} of the pattern; none if the text is not of this form.
std::optional<std::vector<std::string>> values_of(std::string_view text, std::string_view pattern) {
    std::vector<std::string> values;
    for (std::size_t place = pattern.find("{}"); place != pattern.npos; place = pattern.find("{}")) {
        if (!text.starts_with(pattern.substr(0, place))) return {};
        text.remove_prefix(place);
        pattern.remove_prefix(place + 2);
        const std::string_view next = pattern.substr(0, pattern.find("{}"));
        const std::size_t end = next.empty() ? text.size() : text.find(next);
        if (end == text.npos) return {};
        values.emplace_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    if (text != pattern) return {};
    return values;
}

template <typename Patterns>
std::string translated_by(const Patterns& patterns, const std::string& message) {
    for (const char* const pattern : patterns) {
        const auto values = values_of(message, pattern);
        if (!values) continue;
        fmt::dynamic_format_arg_store<fmt::format_context> store;
        for (const std::string& value : *values) store.push_back(translated_by(patterns, value));
        return translated_with(pattern, store);
    }
    return message;
}

}  // namespace

std::string translated_from_library(const std::string& message) {
    return translated_by(patterns, message);
}

std::string translated_from_toml(const std::string& message) {
    return translated_by(toml_patterns, message);
}

}  // namespace alembert

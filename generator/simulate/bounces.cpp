// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/bounces.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "alembert/base/process_time.hpp"
#include "alembert/base/tolerances.hpp"
#include "base/language/say.hpp"
#include "simulate/loaded_modes.hpp"
#include "simulate/run_contacts.hpp"

namespace alembert {

namespace {

std::vector<double> times_of(const HybridMotion& motion, ContactEvent::Kind kind) {
    std::vector<double> list;
    for (const ContactEvent& event : motion.contacts)
        if (event.kind == kind) list.push_back(event.time);
    return list;
}

std::vector<double> kicks_of(const HybridMotion& motion) {
    std::vector<double> list;
    for (const EventRecord& event : motion.events)
        if (!event.impulse.empty()) list.push_back(event.time);
    return list;
}

/// The difference between two motions; infinite if one lacks a release, a contact coming to rest or a kick of the
/// other.
double apart(const HybridMotion& motion, const HybridMotion& reference) {
    double largest = 0;
    const auto states = [&](const std::vector<double>& a, const std::vector<double>& b) {
        largest = std::max(largest, error_against(b, a));
    };
    const std::vector<double> kicks = kicks_of(motion), expected = kicks_of(reference);
    if (kicks.size() != expected.size()) return HUGE_VAL;
    states(kicks, expected);
    states({motion.final_time()}, {reference.final_time()});
    using Kind = ContactEvent::Kind;
    for (const Kind kind : {Kind::impact, Kind::release, Kind::rest}) {
        std::vector<double> a = times_of(motion, kind), b = times_of(reference, kind);
        if (kind != Kind::impact && a.size() != b.size()) return HUGE_VAL;
        const std::size_t both = std::min(a.size(), b.size());
        a.resize(both);
        b.resize(both);
        states(a, b);
    }
    const auto one = motion.final_state(), other = reference.final_state();
    states({one.begin(), one.end()}, {other.begin(), other.end()});
    return largest;
}

}  // namespace

Bounces measured_bounces(const RunOptions& request, const Derived& d, const Start& start,
                         const State<double>& first) {
    const ContactView view(d.mechanism);
    const KickView kicks(d.mechanism, d.scene);
    const Contacts contacts = contacts_of(d, start, view, kicks);
    // Only for the compilation, because only methods that need nothing else are measured.
    const MethodChoice choice;
    CompiledModes compiled(request, d, Work::left_out, choice);
    LoadedModes modes(compiled, start, first,
                      [](LoadedMode&, double, std::span<const double>, std::span<const double>) {});
    std::vector<double> initial = start.q;
    initial.insert(initial.end(), first.qdot.begin(), first.qdot.end());
    Options options{.start = start.t,
                    .duration = request.duration.value_or(start.duration),
                    .longest_step = longest_step(request, start),
                    .budget = request.budget};
    options.sample = options.duration > 0 ? options.duration : 1;
    double seconds = 0;
    const auto run = [&](Method method, double tolerance) {
        options.method = method;
        options.tolerance = tolerance;
        const double before = thread_seconds();
        HybridMotion motion = follow(
            contacts, [&](const std::vector<int>& closed) -> const ContactMode& { return modes(closed).contact; },
            initial, options);
        seconds = thread_seconds() - before;
        return motion;
    };

    const HybridMotion reference = run(Method::verner98, tolerance::finest_contacts),
                       other = run(Method::dop853, tolerance::finest_contacts);
    if (reference.failure) throw_failure(*reference.failure);
    Bounces result;
    result.end = reference.final_time();
    result.final = coordinates_and_rates(modes({}).contact.system.rhs, result.end, reference.final_state().data(),
                                         start.q.size());
    const double agreement = other.failure ? HUGE_VAL : apart(other, reference);
    result.digits = agreement < 1 ? static_cast<int>(std::floor(-std::log10(std::max(agreement, 1e-16)))) : 0;
    result.by = say(
        "verner98 and dop853 at tolerance 1e-13, doubles: states at the end and times of contacts and impulses");
    std::vector<Method> methods = all_methods();
    std::erase_if(methods,
                  [](Method one) { return has_fixed_step(one) || needs_series(one) || needs_separable(one); });
    for (std::size_t k = 0; k < methods.size(); ++k) {
        const Method method = methods[k];
        if (!request.method.empty() && name(method) != request.method) continue;
        for (int decade = 3; decade <= 13; ++decade) {
            if (request.progress)
                request.progress(say("measuring"), (static_cast<double>(k) + (decade - 3) / 11.0) /
                                                       static_cast<double>(methods.size()));
            Measured one{.method = std::string(name(method)), .tolerance = std::pow(10.0, -decade)};
            std::vector<double> all;
            HybridMotion motion;
            for (double sum = 0; all.size() < 3 || (all.size() < 50 && sum < 0.02); sum += seconds) {
                motion = run(method, *one.tolerance);
                all.push_back(seconds);
                if (seconds > 0.3) break;
            }
            std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
            one.seconds = all[all.size() / 2];
            one.evaluations = motion.statistics.evaluations;
            one.steps = motion.statistics.steps;
            if (motion.failure)
                one.failure = motion.failure->message;
            else if (const double error = apart(motion, reference); std::isfinite(error))
                one.error = error;
            else
                one.failure = say("other contacts or impulses than the reference's");
            result.runs.push_back(std::move(one));
            if (result.runs.back().seconds > 1) break;
        }
    }
    return result;
}

}  // namespace alembert

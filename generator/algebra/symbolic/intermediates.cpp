// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/symbolic/intermediates.hpp"

#include <algorithm>
#include <set>

#include "algebra/symbolic/functions.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;
using GiNaC::symbol;

namespace {

bool is_number(const ex& e) {
    return is_a<numeric>(e) || is_a<GiNaC::constant>(e);
}

bool is_atom(const ex& e) {
    if (is_number(e) || is_a<symbol>(e)) return true;
    return is_a<GiNaC::mul>(e) && e.nops() == 2 &&
           ((is_a<numeric>(e.op(0)) && is_a<symbol>(e.op(1))) ||
            (is_a<numeric>(e.op(1)) && is_a<symbol>(e.op(0))));
}

/// Whether `e` is a power that a polynomial may contain.
bool is_whole_power(const ex& e) {
    return is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::integer);
}

/// A flat sum, because GiNaC adds n terms faster at once than one by one.
ex sum_of(GiNaC::exvector terms) {
    if (terms.empty()) return 0;
    return terms.size() == 1 ? terms.front() : ex(GiNaC::add(std::move(terms)));
}

}  // namespace

int Intermediates::source_of(const std::string& label) {
    const auto found = std::find(labels_.begin(), labels_.end(), label);
    const auto index = static_cast<int>(found - labels_.begin());
    if (found == labels_.end()) labels_.push_back(label);
    return index;
}

int Intermediates::set_source(const std::string& label) {
    const int former = current_source_;
    current_source_ = source_of(label);
    return former;
}

void Intermediates::adopt(const Intermediates& other) {
    if (&other == this) return;
    for (const Entry& entry : other.entries_) {
        if (!position_.emplace(entry.symbol.gethash(), entries_.size()).second) continue;
        known_.emplace(entry.definition, entry.symbol);
        entries_.push_back(entry);
        std::vector<int>& sources = entries_.back().sources;
        for (int& source : sources) source = source_of(other.labels_[static_cast<std::size_t>(source)]);
        std::sort(sources.begin(), sources.end());
    }
}

void Intermediates::redefine(const std::function<std::optional<ex>(const ex& definition)>& by) {
    for (Entry& entry : entries_)
        if (const std::optional<ex> definition = by(entry.definition)) {
            entry.definition = *definition;
            entry.uses = symbols_in(*definition);
        }
    partials_.clear();
    last_flow_ = {};
}

const Intermediates::Entry* Intermediates::find(const symbol& s) const {
    const auto found = position_.find(s.gethash());
    return found == position_.end() ? nullptr : &entries_[found->second];
}

std::vector<symbol> Intermediates::symbols_in(const ex& e) const {
    std::map<int, symbol> found;
    std::vector<ex> stack{e};
    while (!stack.empty()) {
        const ex top = stack.back();
        stack.pop_back();
        if (is_a<symbol>(top))
            found.emplace(symbols_->info(ex_to<symbol>(top)).rank, ex_to<symbol>(top));
        else
            for (const ex& child : top) stack.push_back(child);
    }
    std::vector<symbol> result;
    for (auto& [rank, s] : found) result.push_back(s);
    return result;
}

/// Replaces functions and powers that are not whole by symbols, so that a polynomial in atoms remains.
ex Intermediates::flatten(const ex& e) {
    if (is_number(e) || is_a<symbol>(e)) return e;
    if (is_a<GiNaC::function>(e)) {
        GiNaC::exvector args;
        bool is_same = true;  // if true, `e` stays as it is, even if unevaluated like sin(π/10)
        for (const ex& arg : e) {
            args.push_back(name(arg));
            is_same = is_same && args.back().is_equal(arg);
        }
        return name_whole(is_same ? e : ex(ex_to<GiNaC::function>(e).thiscontainer(args)));
    }
    if (is_a<GiNaC::power>(e)) {
        if (is_whole_power(e)) {
            const ex base = flatten(e.op(0));
            return pow(is_a<symbol>(base) || is_number(base) ? base : name(base), e.op(1));
        }
        const ex value = pow(name(e.op(0)), name(e.op(1)));
        // The power may have become a number or a whole power.
        if (is_a<GiNaC::power>(value) && !is_whole_power(value)) return name_whole(value);
        return is_a<GiNaC::power>(value) || is_atom(value) ? value : flatten(value);
    }
    GiNaC::exvector parts;
    for (const ex& part : e) parts.push_back(flatten(part));
    return is_a<GiNaC::add>(e) ? ex(GiNaC::add(std::move(parts))) : ex(GiNaC::mul(std::move(parts)));
}

ex Intermediates::name_whole(const ex& e) {
    if (is_atom(e)) return e;
    if (const auto found = known_.find(e); found != known_.end()) return found->second;
    Entry entry;
    entry.definition = e;
    entry.uses = symbols_in(e);
    entry.tree_size = tree_size(e);
    std::set<int> sources{current_source_};
    // A symbol that is named while no source is set gets the sources of the symbols in its definition, up to a
    // readable number of them.
    for (const symbol& s : entry.uses)
        if (const Entry* used = find(s); used && current_source_ == 0)
            sources.insert(used->sources.begin(), used->sources.end());
    if (sources.size() > 1) sources.erase(0);
    entry.sources.assign(sources.begin(), sources.end());
    if (entry.sources.size() > 4) entry.sources.resize(4);
    entry.symbol = symbols_->declare_intermediate(static_cast<int>(entries_.size()));
    position_.emplace(entry.symbol.gethash(), entries_.size());
    known_.emplace(e, entry.symbol);
    entries_.push_back(std::move(entry));
    return entries_.back().symbol;
}

ex Intermediates::name(const ex& e) {
    const ex flat = flatten(e);
    if (is_atom(flat)) return flat;
    if (is_a<GiNaC::mul>(flat) && is_a<numeric>(flat.op(flat.nops() - 1))) {  // GiNaC keeps the number last
        const ex number = flat.op(flat.nops() - 1);
        return number * name_whole(flat / number);
    }
    return name_whole(flat);
}

double Intermediates::tree_size(const ex& e) const {
    if (is_a<symbol>(e)) {
        const Entry* entry = find(ex_to<symbol>(e));
        return entry ? entry->tree_size : 1;
    }
    double size = 1;
    for (const ex& child : e) size += tree_size(child);
    return size;
}

/// ∂definition/∂by, where the symbols in the definition count as independent.
ex Intermediates::partial(const Entry& entry, const symbol& by) {
    const auto key = std::pair(static_cast<std::size_t>(&entry - entries_.data()), symbols_->info(by).rank);
    if (const auto found = partials_.find(key); found != partials_.end()) return found->second;
    const ex definition = entry.definition;  // a copy, because naming below may move the entries
    const ex self = entry.symbol;
    ex result = 0;
    if (is_a<GiNaC::function>(definition)) {
        for (std::size_t k = 0; k < definition.nops(); ++k) {
            const ex inner = definition.op(k).diff(by);
            if (inner.is_zero()) continue;
            result += inner * flatten(function_derivative(definition, static_cast<int>(k)));
        }
    } else if (is_a<GiNaC::power>(definition) && !is_whole_power(definition)) {
        const ex &base = definition.op(0), &exponent = definition.op(1);
        // 0 at 0, if it is, and no quotient of zeros
        const bool is_less = is_a<numeric>(exponent) && ex_to<numeric>(exponent) < 1;
        result = exponent * (is_less ? self / base : flatten(pow(base, exponent - 1))) * base.diff(by);
        if (const ex outer = exponent.diff(by); !outer.is_zero()) result += flatten(log(base)) * self * outer;
    } else {
        result = definition.diff(by);
    }
    partials_.emplace(key, result);
    return result;
}

/// `e` divided by a power, with the given exponent, of an entry that each of its terms has; nothing if one has it
/// not.
std::optional<ex> Intermediates::without_factor(const ex& e, const symbol& factor, const numeric& power) {
    if (is_a<GiNaC::add>(e)) {
        GiNaC::exvector terms;
        for (const ex& term : e) {
            const std::optional<ex> divided = without_factor(term, factor, power);
            if (!divided) return std::nullopt;
            terms.push_back(*divided);
        }
        return sum_of(std::move(terms));
    }
    if (is_a<GiNaC::mul>(e)) {
        for (std::size_t k = 0; k < e.nops(); ++k)
            if (const std::optional<ex> divided = without_factor(e.op(k), factor, power))
                return e / e.op(k) * *divided;
        return std::nullopt;
    }
    if (e.is_equal(factor)) return flatten(GiNaC::pow(factor, 1 - power));
    if (is_a<GiNaC::power>(e) && e.op(0).is_equal(factor) && is_a<numeric>(e.op(1))) {
        const numeric left = ex_to<numeric>(e.op(1)) - power;
        if (left < 0 || ex_to<numeric>(e.op(1)) <= 0) return std::nullopt;
        return flatten(GiNaC::pow(factor, left));
    }
    if (const Entry* const entry = is_a<symbol>(e) ? find(ex_to<symbol>(e)) : nullptr)
        if (!is_a<GiNaC::function>(entry->definition)) return without_factor(ex(entry->definition), factor, power);
    return std::nullopt;
}

/// weight · ∂definition/∂by, without a sign where it does not matter: max(0, u)ⁿ is zero where max'(0, u) is none,
/// and |u|ⁿ sign u is |u|ⁿ⁻¹ u.
ex Intermediates::weighted_partial(const ex& weight, const Entry& entry, const symbol& by) {
    if (!is_a<GiNaC::function>(entry.definition)) return weight * partial(entry, by);
    const ex definition = entry.definition;  // copies, because naming below may move the entries
    const symbol self = entry.symbol;
    const bool is_bounded = definition.nops() == 2 && (definition.op(0).is_zero() || definition.op(1).is_zero()) &&
                            (is_ex_the_function(definition, maximum) || is_ex_the_function(definition, minimum));
    constexpr int any = 0;
    if (is_bounded && without_factor(weight, self, any))
        return weight * (definition.op(0).is_zero() ? definition.op(1) : definition.op(0)).diff(by);
    if (is_ex_the_function(definition, absolute))
        if (const std::optional<ex> divided = without_factor(weight, self, 1))
            return *divided * definition.op(0) * definition.op(0).diff(by);
    return weight * partial(entry, by);
}

std::vector<std::size_t> Intermediates::reachable(const std::vector<ex>& roots) const {
    std::set<std::size_t> seen;
    std::vector<std::size_t> stack;
    const auto visit = [&](const symbol& s) {
        const auto found = position_.find(s.gethash());
        if (found != position_.end() && seen.insert(found->second).second) stack.push_back(found->second);
    };
    for (const ex& root : roots)
        for (const symbol& s : symbols_in(root)) visit(s);
    while (!stack.empty()) {
        const std::size_t k = stack.back();
        stack.pop_back();
        for (const symbol& s : entries_[k].uses) visit(s);
    }
    return {seen.begin(), seen.end()};
}

bool Intermediates::depends(const ex& e, const std::vector<symbol>& on) const {
    // Most expressions have few symbols, and `on` may be the thousands of a large scene, for each entry of M.
    std::vector<unsigned> used;
    const auto add = [&](const std::vector<symbol>& uses) {
        for (const symbol& s : uses) used.push_back(s.gethash());
    };
    add(symbols_in(e));
    if (used.empty()) return false;
    for (const std::size_t k : reachable({e})) add(entries_[k].uses);
    std::sort(used.begin(), used.end());
    return std::any_of(on.begin(), on.end(),
                       [&](const symbol& s) { return std::binary_search(used.begin(), used.end(), s.gethash()); });
}

std::vector<ex> Intermediates::pull_back(const std::vector<std::pair<ex, ex>>& targets,
                                         const std::vector<symbol>& wrt) {
    std::map<unsigned, GiNaC::exvector> adjoint;  // by symbol hash
    std::vector<ex> roots;
    for (const auto& [target, weight] : targets) roots.push_back(flatten(target));

    // The entries that depend on one of `wrt`.
    std::set<unsigned> leads;
    for (const symbol& s : wrt) leads.insert(s.gethash());
    const std::vector<std::size_t> order = reachable(roots);
    for (const std::size_t k : order)
        for (const symbol& s : entries_[k].uses)
            if (leads.contains(s.gethash())) {
                leads.insert(entries_[k].symbol.gethash());
                break;
            }

    for (std::size_t i = 0; i < roots.size(); ++i)
        for (const symbol& s : symbols_in(roots[i]))
            if (leads.contains(s.gethash())) adjoint[s.gethash()].push_back(targets[i].second * roots[i].diff(s));

    for (auto k = order.rbegin(); k != order.rend(); ++k) {
        const auto found = adjoint.find(entries_[*k].symbol.gethash());
        if (found == adjoint.end()) continue;
        const int former = current_source_;
        current_source_ = entries_[*k].sources.size() == 1 ? entries_[*k].sources.front() : 0;
        const ex weight = name(sum_of(found->second));
        const std::vector<symbol> uses = entries_[*k].uses;
        for (const symbol& s : uses)
            if (leads.contains(s.gethash()))
                adjoint[s.gethash()].push_back(name(weighted_partial(weight, entries_[*k], s)));
        current_source_ = former;
    }
    std::vector<ex> result;
    for (const symbol& s : wrt) result.push_back(name(sum_of(adjoint[s.gethash()])));
    return result;
}

Intermediates::Flow& Intermediates::flow_along(const Direction& direction) {
    const auto same = [](const auto& a, const auto& b) {
        return a.first.is_equal(b.first) && a.second.is_equal(b.second);
    };
    if (last_flow_.direction.size() == direction.size() &&
        std::equal(direction.begin(), direction.end(), last_flow_.direction.begin(), same))
        return last_flow_;
    last_flow_ = {.direction = direction, .dot = {}, .done = {}};
    for (const auto& [s, rate] : direction)
        if (!rate.is_zero()) last_flow_.dot.emplace(s.gethash(), rate);
    return last_flow_;
}

std::vector<ex> Intermediates::push_forward(const std::vector<ex>& values, const Direction& direction) {
    std::vector<ex> roots;
    for (const ex& value : values) roots.push_back(flatten(value));
    Flow& flow = flow_along(direction);
    std::map<unsigned, ex>& dot = flow.dot;
    const auto along = [&](const auto& uses, const auto& derivative) {
        GiNaC::exvector terms;
        for (const symbol& s : uses)
            if (const auto found = dot.find(s.gethash()); found != dot.end())
                terms.push_back(derivative(s) * found->second);
        return sum_of(std::move(terms));
    };
    for (const std::size_t k : reachable(roots)) {
        if (!flow.done.insert(k).second) continue;
        const int former = current_source_;
        current_source_ = entries_[k].sources.size() == 1 ? entries_[k].sources.front() : 0;
        const std::vector<symbol> uses = entries_[k].uses;
        const ex rate = name(along(uses, [&](const symbol& s) { return partial(entries_[k], s); }));
        if (!rate.is_zero()) dot.emplace(entries_[k].symbol.gethash(), rate);
        current_source_ = former;
    }
    std::vector<ex> result;
    for (const ex& root : roots)
        result.push_back(name(along(symbols_in(root), [&](const symbol& s) { return root.diff(s); })));
    return result;
}

ex Intermediates::expand(const ex& e) const {
    GiNaC::exmap full;
    for (const std::size_t k : reachable({e}))
        full[entries_[k].symbol] = entries_[k].definition.subs(full, GiNaC::subs_options::no_pattern);
    return e.subs(full, GiNaC::subs_options::no_pattern);
}

}  // namespace alembert

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Translates the scene's expression trees to symbols: names are looked up, primes differentiate, and vector
/// functions query the geometry.

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <variant>

#include "model/geometry.hpp"
#include "model/root_sheets.hpp"

namespace alembert {

/// A scalar, or a vector along the axes of N.
using Value = std::variant<GiNaC::ex, Vector3>;

/// The queries to the geometry. Each may throw std::out_of_range for a name that it does not know.
struct GeometryQueries {
    std::function<Vector3(const std::string&point)> position, velocity;
    std::function<const Orientation&(const std::string& frame)> orientation;
};

class Translator {
public:
    Translator(const Mechanism& mechanism, GeometryQueries queries)
        : mechanism_(mechanism), queries_(std::move(queries)) {}

    /// Declares a name that stands for a value: a coordinate's symbol, a definition's value …
    void know(const std::string& name, const Value& value) {
        forget(name);
        values_[name] = value;
    }
    /// Declares a name whose value is computed when it is first asked for (definitions, in any order).
    void know_later(const std::string& name, std::function<Value()> value) { later_[name] = std::move(value); }

    bool knows(const std::string& name) const;
    void forget(const std::string& name) { later_.erase(name), values_.erase(name), offered_.erase(name); }
    /// `know_later` for a name that no scene declares: that it does not depend on t by itself may be said.
    void offer(const std::string& name, std::function<Value()> value) {
        know_later(name, std::move(value));
        offered_.insert(name);
    }
    bool is_offered(const std::string& name) const { return offered_.contains(name); }
    /// Declares calls that are no functions of the language: T(M1). Nothing for any other.
    void know_calls(std::function<std::optional<Value>(const Tree& call)> calls) { calls_ = std::move(calls); }
    /// Declares partial derivatives that hold something else than the rates. Nothing for any other.
    void know_partials(std::function<std::optional<GiNaC::ex>(const Tree& of, const Tree& by)> partials) {
        partials_ = std::move(partials);
    }

    /// Declares a function of [functions].
    void know_function(const GiNaC::symbol& function) { functions_.emplace(function.get_name(), function); }

    /// Declares a symbol whose time derivative is not known (an acceleration, a multiplier). Differentiating it is
    /// a mistake.
    void has_no_derivative(const GiNaC::symbol& symbol) { without_derivative_.push_back(symbol); }

    /// From now on √(e²) becomes e or −e (model/root_sheets.hpp).
    void go_on(std::shared_ptr<RootSheets> sheets) { sheets_ = std::move(sheets); }
    /// |v|, on the sheet.
    GiNaC::ex length(const Vector3& v);
    /// A function of the scene language (`sqrt`, `abs`, `sign` on the sheet); nothing if there is none of this
    /// name.
    std::optional<GiNaC::ex> applied(const std::string& function, const std::vector<GiNaC::ex>& args);

    /// Throws SceneMistake for mistakes that the reader could not see.
    GiNaC::ex scalar(const Expression& expression);
    /// The same, of an expression that may be a vector. A number gets an intermediate symbol.
    Value value(const Expression& expression);

    // For what `know_calls` gives, while an expression is being translated:
    Vector3 vector_of(const Tree& tree);
    GiNaC::ex scalar_of(const Tree& tree);
    /// What a name stands for.
    GiNaC::ex scalar_named(const std::string& name);
    Place place_of(const Tree& tree) const { return current_->place(tree.offset); }

private:
    Value evaluate(const Tree& tree);
    Value named(const Tree& tree);
    Value call(const Tree& tree);
    GiNaC::ex power(const GiNaC::ex& base, const GiNaC::ex& exponent);
    Vector3 rate_of(const Vector3& v) const;
    /// dot(omega(B), ex(B)) and the like of alpha, which are known without going by N.
    std::optional<GiNaC::ex> own_component(const Tree& u, const Tree& v) const;
    GiNaC::ex differentiated(GiNaC::ex value, int times, const Tree& tree);
    GiNaC::ex partial(const Tree& tree);
    GiNaC::ex by_argument(const GiNaC::ex& value, const Tree& by);

    const Mechanism& mechanism_;
    GeometryQueries queries_;
    std::map<std::string, Value> values_;
    std::map<std::string, std::function<Value()>> later_;
    std::set<std::string> offered_;
    std::map<std::string, GiNaC::symbol> functions_;
    std::function<std::optional<Value>(const Tree& call)> calls_;
    std::function<std::optional<GiNaC::ex>(const Tree& of, const Tree& by)> partials_;
    std::vector<GiNaC::symbol> without_derivative_;
    std::shared_ptr<RootSheets> sheets_;
    const Expression* current_ = nullptr;
};

/// Thrown if a translated expression turns out to be wrong; the builder collects these into one SceneError.
struct SceneMistake {
    Diagnostic diagnostic;
};

}  // namespace alembert

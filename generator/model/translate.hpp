// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// From the scene's expression trees to symbols: names are looked up, primes differentiate, vector functions ask
/// the geometry.

#include <functional>
#include <map>
#include <memory>
#include <variant>

#include "model/geometry.hpp"
#include "model/root_sheets.hpp"

namespace alembert {

/// A scalar, or a vector along the axes of N.
using Value = std::variant<GiNaC::ex, Vector3>;

/// What the geometry answers; each may throw std::out_of_range for a name that it does not know.
struct GeometryQueries {
    std::function<Vector3(const std::string&point)> position, velocity;
    std::function<const Orientation&(const std::string& frame)> orientation;
};

class Translator {
public:
    Translator(const Mechanism& mechanism, GeometryQueries queries)
        : mechanism_(mechanism), queries_(std::move(queries)) {}

    /// A name that stands for a value: a coordinate's symbol, a definition's value …
    void know(const std::string& name, const Value& value) { values_[name] = value; }
    /// A name whose value is made when first asked for (definitions, in any order).
    void know_later(const std::string& name, std::function<Value()> value) { later_[name] = std::move(value); }

    /// A symbol whose time derivative nobody knows: an acceleration, a multiplier. To differentiate it is a
    /// mistake.
    void has_no_derivative(const GiNaC::symbol& symbol) { without_derivative_.push_back(symbol); }

    /// From now on √(e²) is e or −e (model/root_sheets.hpp).
    void go_on(std::shared_ptr<RootSheets> sheets) { sheets_ = std::move(sheets); }
    /// |v|, on the sheet.
    GiNaC::ex length(const Vector3& v);

    /// Throws SceneMistake for what the reader could not see.
    GiNaC::ex scalar(const Expression& expression);
    /// The same, of an expression that may be a vector. A number gets an intermediate symbol.
    Value value(const Expression& expression);

private:
    Value evaluate(const Tree& tree);
    GiNaC::ex scalar_of(const Tree& tree);
    Vector3 vector_of(const Tree& tree);
    Value named(const Tree& tree);
    Value call(const Tree& tree);
    GiNaC::ex power(const GiNaC::ex& base, const GiNaC::ex& exponent);
    Vector3 rate_of(const Vector3& v) const;
    /// dot(omega(B), ex(B)) and the like of alpha, which are known without going by N.
    std::optional<GiNaC::ex> own_component(const Tree& u, const Tree& v) const;
    GiNaC::ex differentiated(GiNaC::ex value, int times, const Tree& tree);

    const Mechanism& mechanism_;
    GeometryQueries queries_;
    std::map<std::string, Value> values_;
    std::map<std::string, std::function<Value()>> later_;
    std::vector<GiNaC::symbol> without_derivative_;
    std::shared_ptr<RootSheets> sheets_;
    const Expression* current_ = nullptr;
};

/// Thrown where a translated expression turns out wrong; the builder gathers these into one SceneError.
struct SceneMistake {
    Diagnostic diagnostic;
};

}  // namespace alembert

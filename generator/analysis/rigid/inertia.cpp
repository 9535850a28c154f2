// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/rigid/inertia.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "alembert/base/inertia.hpp"
#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "algebra/symbolic/fourier.hpp"
#include "analysis/state/assemble.hpp"
#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "model/formulas.hpp"
#include "model/geometry.hpp"
#include "program/lower/lower.hpp"
#include "scene/body_points.hpp"
#include "scene/text.hpp"
#include "scene/used_places.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double largest_shown = 3000;  // the most nodes of an expression
constexpr int most_terms_shown = 40;

std::string name_of(const Scene& scene, const Origin& origin) {
    const auto k = static_cast<std::size_t>(origin.index);
    return origin.kind == Origin::Kind::body ? scene.bodies[k].name.text : scene.particles[k].name.text;
}

void refuse_unknown(const std::string& kind, const std::string& name, const std::vector<std::string>& known) {
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    const std::string meant = nearest(name, known);
    throw ModelError(say("there is no {} {}{}; expected one of: {}", kind, in_quotes(name),
                         meant.empty() ? "" : say(" (did you mean '{}'?)", meant), fmt::join(known, ", ")));
}

std::vector<const MassElement*> chosen(const SceneInertia& s, const std::vector<std::string>& names) {
    std::vector<std::string> known;
    std::vector<const MassElement*> result;
    for (const MassElement& element : s.mechanism.masses) {
        if (element.origin.kind != Origin::Kind::body && element.origin.kind != Origin::Kind::particle) continue;
        known.push_back(name_of(s.scene, element.origin));
        if (names.empty() || std::find(names.begin(), names.end(), known.back()) != names.end())
            result.push_back(&element);
    }
    if (known.empty())
        throw ModelError(
            say("the scene has no bodies and no particles, whose inertia could be told; expected [[body]]"));
    for (const std::string& name : names) refuse_unknown(say("body or particle"), name, known);
    return result;
}

void check_point(const Scene& scene, const std::string& point) {
    std::vector<std::string> known{"O"};
    for (std::string& name : points_of(scene)) known.push_back(std::move(name));
    refuse_unknown(say("point"), point, known);
}

/// plain + over/m, with m the whole mass. The part that is divided by a sum is kept separate, so that it can be
/// read.
struct Entry {
    ex plain = 0, over = 0;
};

/// Computes mass, mass centre and tensor as expressions.
class Adding {
public:
    Adding(SceneInertia& s, std::vector<const MassElement*> elements)
        : s_(s), z_(*s.mechanism.z), elements_(std::move(elements)), is_single_(elements_.size() == 1) {
        GiNaC::exvector masses;
        for (const MassElement* e : elements_) masses.push_back(e->mass);
        mass_ = z_.name(GiNaC::add(masses));
        for (std::size_t i = 0; i < 3; ++i) basis_[i][i] = 1;
        if (is_single_ && elements_[0]->rotation) {
            basis_ = elements_[0]->rotation->axes;
            s_.along = s_.of[0];
        }
    }

    void about(const std::string& point) {
        Formulas formulas(s_.scene, s_.mechanism);
        reference_ = formulas.places().position(point);
    }

    const ex& mass() const { return mass_; }

    /// The mass centre, then the tensor row by row.
    std::vector<Entry> entries() {
        std::vector<Entry> result;
        for (std::size_t i = 0; i < 3; ++i) {
            GiNaC::exvector moments;
            for (const MassElement* e : elements_) moments.push_back(e->mass * e->position[i]);
            result.push_back(is_single_ ? Entry{elements_[0]->position[i], 0}
                                        : Entry{0, z_.name(GiNaC::add(moments))});
        }
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                result.push_back({z_.name(own(i, j) + steiner(i, j)), z_.name(pairs(i, j))});
        return result;
    }

private:
    /// The sum of the bodies' own tensors. That of a single body, along its own axes, need not be turned.
    ex own(std::size_t i, std::size_t j) {
        constexpr std::size_t place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
        GiNaC::exvector terms;
        for (const MassElement* e : elements_) {
            if (!e->rotation) continue;
            const std::array<ex, 6> I = central_inertia(*e, z_);
            if (is_single_) return I[place[i][j]];
            for (std::size_t a = 0; a < 3; ++a)
                for (std::size_t b = 0; b < 3; ++b)
                    terms.push_back(e->rotation->axes[a][i] * I[place[a][b]] * e->rotation->axes[b][j]);
        }
        return GiNaC::add(terms);
    }

    /// d·d δ_ij − d_i d_j
    ex spread(const Vector3& d, std::size_t i, std::size_t j) {
        const ex product = dot(d, basis_[i], z_) * dot(d, basis_[j], z_);
        return i == j ? dot(d, d, z_) - product : -product;
    }

    Vector3 between(const Vector3& from, const Vector3& to) {
        return {z_.name(to[0] - from[0]), z_.name(to[1] - from[1]), z_.name(to[2] - from[2])};
    }

    /// The contribution of the mass centres about a given point.
    ex steiner(std::size_t i, std::size_t j) {
        GiNaC::exvector terms;
        if (reference_)
            for (const MassElement* e : elements_)
                terms.push_back(e->mass * spread(between(*reference_, e->position), i, j));
        return GiNaC::add(terms);
    }

    /// The contribution of the mass centres about the common one: Σ m_k m_l (d·d E − d dᵀ)/m over all pairs, with
    /// d from one to the other.
    ex pairs(std::size_t i, std::size_t j) {
        GiNaC::exvector terms;
        for (std::size_t k = 0; k < elements_.size() && !reference_; ++k)
            for (std::size_t l = 0; l < k; ++l)
                terms.push_back(elements_[k]->mass * elements_[l]->mass *
                                spread(between(elements_[l]->position, elements_[k]->position), i, j));
        return GiNaC::add(terms);
    }

    SceneInertia& s_;
    Intermediates& z_;
    std::vector<const MassElement*> elements_;
    bool is_single_;
    ex mass_;
    std::array<Vector3, 3> basis_{Vector3{0, 0, 0}, Vector3{0, 0, 0}, Vector3{0, 0, 0}};
    std::optional<Vector3> reference_ = {};
};

std::optional<Phrase> short_form(const Mechanism& m, const ex& e) {
    if (m.z->tree_size(e) > largest_shown) return std::nullopt;
    const auto f = fourier(m.z->expand(e), *m.symbols, 500);
    if (!f || f->size() > most_terms_shown) return std::nullopt;
    return readable(*f);
}

std::optional<std::string> text_of(const Mechanism& m, const Entry& entry, const std::optional<Phrase>& mass) {
    const std::optional<Phrase> plain = short_form(m, entry.plain), over = short_form(m, entry.over);
    if (!plain || !over || !mass) return std::nullopt;
    const auto is_zero = [](const Phrase& p) { return p.kind == Phrase::Kind::number && cln::zerop(p.value); };
    if (is_zero(*over)) return text(*plain);
    Phrase divided = phrases::quotient(*over, *mass);
    return text(is_zero(*plain) ? divided : phrases::sum({*plain, std::move(divided)}));
}

}  // namespace

SceneInertia inertia(Scene scene, const InertiaOptions& options) {
    are_used(scene, {options.about});
    SceneInertia result{prepared(std::move(scene), options.at, false, Coordinates::optional)};
    const std::vector<const MassElement*> elements = chosen(result, options.of);
    for (const MassElement* e : elements) result.of.push_back(name_of(result.scene, e->origin));
    result.about = options.about;
    if (!options.about.empty()) check_point(result.scene, options.about);
    Adding adding(result, elements);
    if (!options.about.empty()) adding.about(options.about);
    const std::vector<Entry> entries = adding.entries();

    Start start = start_of(result.mechanism, options.at);
    assemble(start, result.mechanism, lower_constraints(result.mechanism), options.at);
    std::vector<ex> wanted{adding.mass()};
    for (const Entry& entry : entries) wanted.insert(wanted.end(), {entry.plain, entry.over});
    Program program;
    const std::vector<int> nodes = lower_expressions(program, result.mechanism, wanted);
    const std::vector<double> value = interpret(program, start.state());
    result.mass = value[nodes[0]];
    const std::optional<Phrase> mass = short_form(result.mechanism, adding.mass());
    if (mass) result.mass_text = text(*mass);
    const auto number = [&](std::size_t k) {
        const double over = value[nodes[2 + 2 * k]];
        return value[nodes[1 + 2 * k]] + (over == 0 ? 0 : over / result.mass);
    };
    for (std::size_t i = 0; i < 3; ++i) {
        result.centre[i] = number(i);
        result.centre_text[i] = text_of(result.mechanism, entries[i], mass);
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t k = 3 + 3 * i + j;
            result.tensor(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = number(k);
            result.tensor_text[i][j] = text_of(result.mechanism, entries[k], mass);
        }
    }
    const PrincipalAxes<double> own = principal_axes<double>(result.tensor);
    const double rounding = 1e-14 * own.moments.cwiseAbs().maxCoeff();  // of a rod's moment about its axis
    for (Eigen::Index k = 0; k < 3; ++k)
        result.principal.push_back(  // 0.0 is added because −0 is a confusing component
            {std::abs(own.moments[k]) <= rounding ? 0 : own.moments[k],
             {own.R(0, k) + 0.0, own.R(1, k) + 0.0, own.R(2, k) + 0.0}});
    return result;
}

}  // namespace alembert

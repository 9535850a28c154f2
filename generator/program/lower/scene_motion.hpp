// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How points and frames of a scene move, along N, as nodes of a program.
///
///     SceneMotion motion(program, scene, mechanism, false);
///     const SceneMotion::Spot hand = motion.spot("hand");
///     motion.velocity(hand, motion.rates());          // (v, ω) in q and q'
///     motion.velocity(hand, motion.unit_rate(2));     // column 2 of the geometric Jacobian
///
/// From a frame to one that turns against it by φ about a, and along a step by ρ from a point to the next,
///     ω ← ω + φ' a,    α ← α + φ'' a + φ' ω × a,
///     v ← v + ω × ρ + ρ',    a ← a + α × ρ + ω × (ω × ρ) + 2 ω × ρ' + ρ''
/// (Kane & Levinson, Dynamics (1985), chapter 2). Successive steps with the same ω are taken as one, so that a
/// column of a Jacobian takes one cross product.

#include <functional>
#include <map>
#include <set>

#include "model/formalism/spatial.hpp"
#include "model/formulas.hpp"
#include "program/symbolic_scalar.hpp"

namespace alembert {

using SymbolicVector = Triple<Symbolic>;

/// Linear and angular part.
struct LinearAngular {
    Triple<Symbolic> linear{0, 0, 0}, angular{0, 0, 0};
};

/// Throws ModelError for what SceneMotion::spot does not take.
void check_spot(const Scene& scene, const std::string& name);

class SceneMotion {
public:
    /// The arguments must outlive the object, and `mechanism` must have a table of intermediate symbols of its
    /// own.
    SceneMotion(Program& program, const Scene& scene, const Mechanism& mechanism, bool fold);
    SceneMotion(const SceneMotion&) = delete;
    SceneMotion& operator=(const SceneMotion&) = delete;

    /// A point, and the frame in which it is thought to be fixed: positions in the skeleton.
    struct Spot {
        int point = 0, frame = 0;
    };
    /// "P": a point, particle or body with the axes of the frame of the same name, or else of the frame along
    /// which its position is given; "P@F": with the axes of F. Throws ModelError for names that the scene does not
    /// have, and for a frame, which has no place.
    Spot spot(const std::string& name);
    /// The mass centre of a body or particle, and the body's own frame.
    Spot spot_of(const MassElement& mass);
    /// The farthest point towards the ground that is fixed to the body's frame, and the mass centre from there
    /// along this frame. A particle is its own origin.
    struct Origin {
        Spot spot;
        std::array<GiNaC::ex, 3> centre{0, 0, 0};
    };
    Origin origin_of(const MassElement& mass);

    /// Lowers expressions with the rates, or accelerations, as symbols or as numbers.
    class Rates {
    public:
        Rates(SceneMotion& of, const std::vector<std::pair<GiNaC::symbol, int>>& given);
        Symbolic operator()(const GiNaC::ex& e) const { return {*program_, lowering_(e)}; }

    private:
        friend class SceneMotion;
        Program* program_;
        std::function<int(const GiNaC::ex&)> lowering_;
        mutable std::map<int, Triple<Symbolic>> angular_, angular_rate_;  // ω and α by frame
    };
    const Rates& rates() { return symbolic_; }
    /// q'_k = 1 and all others 0.
    const Rates& unit_rate(int k);

    Matrix<Symbolic> rotation(int frame);  ///< takes components along the frame to components along N
    SymbolicVector position(int point);
    LinearAngular velocity(const Spot& spot, const Rates& rates);
    /// Column k of the geometric Jacobian; without what moves when all rates are zero.
    LinearAngular column(const Spot& spot, int k);
    /// With `accelerated`, in q'' too; otherwise at q'' = 0.
    LinearAngular acceleration(const Spot& spot, bool accelerated);

    /// ω and α of a frame along its own axes, as linear and angular part.
    LinearAngular turning(int frame);
    SymbolicVector gravity() {
        return {symbolic_(m_.gravity[0]), symbolic_(m_.gravity[1]), symbolic_(m_.gravity[2])};
    }

    Symbolic whole_mass() const { return total_; }
    SymbolicVector mass_centre() { return Symbolic(1) / total_ * moment_; }
    /// Σ m v at q'_k = 1 and all other rates 0, without what moves when all rates are zero.
    SymbolicVector linear_momentum_column(int k) {
        return linear_momentum(unit_rate(k)) - linear_momentum(resting_);
    }
    /// Σ m v, and the angular momentum about the mass centre.
    LinearAngular momentum() { return momentum(symbolic_); }
    /// The same at q'_k = 1 and all other rates 0, without what moves when all rates are zero.
    LinearAngular momentum_column(int k);
    /// The derivative of the momentum by time at q'' = 0.
    LinearAngular momentum_drift();

private:
    SymbolicVector along_N(int frame, const Vector3& components, const Rates& rates);
    const SymbolicVector& angular(int frame, const Rates& rates);
    const SymbolicVector& angular_rate(int frame, const Rates& rates);
    /// ρ of the step that leads to a point, and its derivatives along the frame of the step, all along N.
    SymbolicVector step(int point) { return along_N(step_of(point).frame, step_of(point).offset, symbolic_); }
    SymbolicVector step_rate(int point, const Rates& rates, int order);
    const Skeleton::Step& step_of(int point) {
        return places().skeleton().points[static_cast<std::size_t>(point)];
    }
    std::vector<int> way(int point);  ///< the points from O to this one, without O
    bool same(const SymbolicVector& a, const SymbolicVector& b);
    SymbolicVector linear_momentum(const Rates& rates);
    LinearAngular momentum(const Rates& rates);
    /// The tensor of inertia about the mass centre, along N or along the body's frame.
    Symmetric<Symbolic> inertia_along_N(const MassElement& mass);
    Symmetric<Symbolic> inertia_along_body(const MassElement& mass);
    void gather_masses();
    /// The rates of Σ m ρ over the step to this point and all beyond it: with turns, and of shifts alone.
    SymbolicVector moment_rate(int point, const Rates& rates);
    SymbolicVector shift_rate(int point, const Rates& rates);
    Places& places() { return formulas_.places(); }

    /// The masses that a step carries.
    struct Carried {
        Symbolic mass = 0;
        SymbolicVector moment{0, 0, 0};  ///< Σ m ρ over this step and those beyond it
        std::vector<int> next = {};      ///< the points with masses that hang from this one
        std::set<int> frames = {};       ///< the frames of all steps from here on
    };

    Program& p_;
    const Scene& scene_;
    const Mechanism& m_;
    bool fold_;
    Formulas formulas_;
    Rates symbolic_, resting_, unaccelerated_;
    std::map<int, Rates> units_;
    std::map<int, Matrix<Symbolic>> rotations_;
    std::map<int, Carried> carried_;  ///< by point
    Symbolic total_ = 0;
    SymbolicVector moment_{0, 0, 0};  ///< Σ m r
};

}  // namespace alembert

// SPDX-License-Identifier: GPL-2.0-or-later
// The mass m, the mass centre c and the inertia I (about the mass centre, along common axes) of bodies that are
// fixed to each other:
//   m = Σ m_i,   m c = Σ m_i c_i,   I = Σ I_i + m_i (d·d E − d dᵀ),   d = c_i − c.
#include "scene/import/welded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "alembert/base/inertia.hpp"
#include "base/language/say.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

class Welder {
public:
    Welder(const Robot& robot, bool floating, bool mend) : robot_(robot), floating_(floating), mend_(mend) {}

    WeldedLinks weld() {
        gather();
        leave_out_massless();
        return std::move(result_);
    }

private:
    const Robot::Link& link(int i) const { return robot_.links[static_cast<std::size_t>(i)]; }
    const Seat& seat(int i) const { return result_.seats[static_cast<std::size_t>(i)]; }

    void gather() {
        result_.seats.resize(robot_.links.size());
        place(robot_.root);
        result_.bodies[0].ground = !floating_;
        for (std::size_t g = 0; g < result_.bodies.size(); ++g) sum_up(result_.bodies[g]);
        if (result_.bodies[0].ground && result_.bodies[0].mass != 0) {
            std::vector<std::string> names;
            for (const int i : result_.bodies[0].links)
                if (link(i).mass != 0) names.push_back(link(i).name);
            drop(say("mass that is fixed to the ground"), names);
        }
    }
    int new_group(int top) {
        result_.bodies.push_back({.top = top, .links = {}});
        return static_cast<int>(result_.bodies.size()) - 1;
    }
    /// Walks from the root outwards without recursion, in the order of the file.
    void place(int root) {
        std::vector<std::vector<const Robot::Joint*>> below(robot_.links.size());
        for (const Robot::Joint& joint : robot_.joints)
            below[static_cast<std::size_t>(joint.parent)].push_back(&joint);
        std::vector<int> waiting{root};
        while (!waiting.empty()) {
            const int i = waiting.back();
            waiting.pop_back();
            Seat& own = result_.seats[static_cast<std::size_t>(i)];
            if (own.group < 0) own.group = new_group(i);
            result_.bodies[static_cast<std::size_t>(own.group)].links.push_back(i);
            const auto& list = below[static_cast<std::size_t>(i)];
            for (auto joint = list.rbegin(); joint != list.rend(); ++joint) {
                const int child = (*joint)->child;
                waiting.push_back(child);
                if ((*joint)->type == Robot::Type::fixed)
                    result_.seats[static_cast<std::size_t>(child)] = fixed(own, **joint);
            }
            const int above = link(i).joint;
            if (above >= 0 && robot_.joints[static_cast<std::size_t>(above)].type == Robot::Type::fixed)
                result_.merged.push_back(say("{} is fixed to {}", link(i).name,
                                             link(robot_.joints[static_cast<std::size_t>(above)].parent).name));
        }
    }
    static Seat fixed(const Seat& parent, const Robot::Joint& joint) {
        Seat next{.group = parent.group,
                  .shift = parent.shift + parent.R * joint.at.shift,
                  .R = parent.R * joint.at.rotation(),
                  .turns = parent.turns};
        next.turns.push_back(joint.at.rpy);
        return next;
    }

    /// What is left of moments by rounding, where they are differences of larger ones: a part of the largest
    /// element, of m r² about the origin, or of the moment of a body of a micrometre.
    double rounding_of(const WeldedBody& group, const std::vector<int>& heavy) const {
        constexpr double part = 1e-14, micrometre = 1e-6;
        double size = 0;
        for (const int i : heavy) {
            const double far = (seat(i).shift + seat(i).R * link(i).centre).squaredNorm();
            size = std::max({size, link(i).inertia.cwiseAbs().maxCoeff(), std::abs(link(i).mass) * far});
        }
        return std::max(part * size, std::abs(group.mass) * micrometre * micrometre);
    }

    /// The nearest inertia of real masses: J = tr(I)/2 E − I = ∫ ρ ρᵀ dm has no negative eigenvalue.
    void mend(WeldedBody& group, double least) {
        const Real33 J = group.inertia.trace() / 2 * Real33::Identity() - group.inertia;
        const Eigen::SelfAdjointEigenSolver<Real33> own(J);
        if (!own.eigenvalues().allFinite() || own.eigenvalues()[0] >= -least) return;
        const Real3 kept = own.eigenvalues().cwiseMax(0);
        const Real3 before = principal_axes<double>(group.inertia).moments;
        group.inertia = kept.sum() * Real33::Identity() -
                        own.eigenvectors() * kept.asDiagonal() * own.eigenvectors().transpose();
        const Real3 after = principal_axes<double>(group.inertia).moments;
        result_.mended.push_back(
            say("the inertia of link {} is none of a body: its principal moments {:.6g}, {:.6g} and {:.6g} became "
                "{:.6g}, {:.6g} and {:.6g}",
                in_quotes(link(group.top).name), before[0], before[1], before[2], after[0], after[1], after[2]));
    }

    void sum_up(WeldedBody& group) {
        std::vector<int> heavy;
        for (const int i : group.links)
            if (link(i).mass != 0 || !link(i).inertia.isZero(0)) heavy.push_back(i);
        const auto centre = [&](int i) -> Real3 { return seat(i).shift + seat(i).R * link(i).centre; };
        for (const int i : heavy) group.mass += link(i).mass;
        if (heavy.size() == 1)
            group.centre = centre(heavy[0]);
        else if (group.mass != 0)
            for (const int i : heavy) group.centre += link(i).mass / group.mass * centre(i);
        for (const int i : heavy)
            group.inertia += moved_from_centre<double>(turned<double>(link(i).inertia, seat(i).R), link(i).mass,
                                                       centre(i) - group.centre);
        const double rounding = rounding_of(group, heavy);
        const double size = group.inertia.cwiseAbs().maxCoeff();
        group.inertia = group.inertia.unaryExpr(
            [&](double x) { return std::abs(x) <= 4 * std::numeric_limits<double>::epsilon() * size ? 0 : x; });
        if (group.inertia.cwiseAbs().maxCoeff() <= rounding) group.inertia.setZero();
        if (mend_ && !group.ground) mend(group, rounding / rounded_moment);
        if (const PrincipalAxes<> own = principal_axes<double>(group.inertia);
            !group.ground && has_negative_moment(own, rounding / rounded_moment))
            throw ModelError(
                say("link {}{} has the principal moments of inertia {:.6g}, {:.6g} and {:.6g}, which are not all "
                    "zero or more; no body has them (--mend-inertia takes the nearest that a body has)",
                    in_quotes(link(group.top).name),
                    group.links.size() > 1 ? say(", with all that is fixed to it,") : "", own.moments[0],
                    own.moments[1], own.moments[2]));
    }

    void leave_out_massless() {
        std::vector<std::string> names;
        const auto of = [&](const WeldedBody& group) { return link(group.top).joint; };
        for (bool again = true; again;) {
            again = false;
            for (WeldedBody& group : result_.bodies) {
                if (group.ground || !group.kept || group.mass != 0 || !group.inertia.isZero(0) || of(group) < 0)
                    continue;
                const int own = of(group);
                const bool needed =
                    std::any_of(result_.bodies.begin(), result_.bodies.end(), [&](const WeldedBody& other) {
                        if (!other.kept || of(other) < 0 || &other == &group) return false;
                        const Robot::Joint& joint = robot_.joints[static_cast<std::size_t>(of(other))];
                        return &result_.bodies[static_cast<std::size_t>(seat(joint.parent).group)] == &group ||
                               (joint.mimic && joint.mimic->joint == own);
                    });
                const bool in_a_loop =
                    std::any_of(robot_.loops.begin(), robot_.loops.end(), [&](const Robot::Loop& loop) {
                        return group.links.end() !=
                               std::find_if(group.links.begin(), group.links.end(),
                                            [&](int i) { return i == loop.parent || i == loop.child; });
                    });
                if (needed || in_a_loop) continue;
                group.kept = false;
                again = true;
                names.push_back(robot_.joints[static_cast<std::size_t>(own)].name);
            }
        }
        drop(say("joints that move no mass"), names);
    }

    void drop(const std::string& what, std::vector<std::string> of) {
        if (!of.empty()) result_.dropped.push_back({what, std::move(of)});
    }

    const Robot& robot_;
    const bool floating_, mend_;
    WeldedLinks result_;
};

}  // namespace

WeldedLinks welded(const Robot& robot, bool floating, bool mend) {
    return Welder(robot, floating, mend).weld();
}

}  // namespace alembert

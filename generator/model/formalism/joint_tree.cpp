// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/formalism/joint_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "base/language/say.hpp"
#include "model/formalism/ball_joint.hpp"
#include "model/formalism/elements.hpp"
#include "model/links.hpp"
#include "model/parameter_values.hpp"
#include "scene/text.hpp"

namespace alembert {

using GiNaC::ex;
using NamedVector = Triple<Named>;
using Rotation3 = Matrix<Named>;

namespace {

Rotation3 unity() {
    return {NamedVector{1, 0, 0}, NamedVector{0, 1, 0}, NamedVector{0, 0, 1}};
}

bool is_unity(const Rotation3& R) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (!R[i][j].e.is_equal(i == j ? 1 : 0)) return false;
    return true;
}

bool same_axis(const Vector3& a, const Vector3& b) {
    return a[0].is_equal(b[0]) && a[1].is_equal(b[1]) && a[2].is_equal(b[2]);
}

/// The position of a point in a link's own axes, and the orientation of a frame relative to these.
struct Seat {
    int link = -1;
    Rotation3 to_link = unity();  ///< converts components along the frame's axes to components along the link's
    NamedVector at{0, 0, 0};
};

/// Whether points may move along curves, or along lines only.
enum class Curves { allowed, refused };

class Finder {
public:
    Finder(const Mechanism& m, const Skeleton& skeleton, Curves curves)
        : m_(m), skeleton_(skeleton), curves_(curves), z_(*m.z) {
        tree_.coordinates = m.size();
    }

    Possible<JointTree> find() {
        for (int k = 0; k < 3; ++k) tree_.gravity[k] = named(m_.gravity[k]);
        for (const MassElement& body : m_.masses) {
            label_ = shown_label(body.origin);
            if (!body.mass_rate.is_zero()) refuse(say("the mass of {} changes", label_));
            add(body);
            if (obstacle_) return *obstacle_;
        }
        for (const Rotor& rotor : m_.rotors) add(rotor);
        if (!tree_.balls.empty()) check_alone();
        if (obstacle_) return *obstacle_;
        return std::move(tree_);
    }

private:
    Named named(const ex& e) { return {e, z_}; }
    NamedVector named(const Vector3& v) { return {named(v[0]), named(v[1]), named(v[2])}; }
    bool moves(const ex& e) const { return m_.z->depends(e, moving_); }

    /// Only the first obstacle is kept; what is computed afterwards does not matter any more.
    void refuse(const std::string& why) {
        if (!obstacle_)
            obstacle_ = Obstacle{say("the recursive formalism goes from body to body along joints: {}", why)};
    }

    std::string shown(const ex& e) const {
        if (z_.tree_size(e) > 300) return "…";
        const auto f = fourier(z_.expand(e), *m_.symbols, 20);
        return f ? text(readable(*f)) : "…";
    }

    /// Rodrigues' formula.
    Rotation3 turn(const Vector3& a, const ex& angle) {
        const ex c = z_.name(cos(angle)), s = z_.name(sin(angle));
        Rotation3 R = unity();
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) {
                const ex tilde = i == k ? ex(0) : ((k - i + 3) % 3 == 1 ? -a[3 - i - k] : a[3 - i - k]);
                R[i][k] = named(
                    a[i].is_equal(1) && i == k ? ex(1) : (i == k ? c : ex(0)) + (1 - c) * a[i] * a[k] + s * tilde);
            }
        return R;
    }

    /// Axes whose z axis is `a`, as columns.
    Rotation3 axes_along(const Vector3& a) {
        for (int k = 0; k < 3; ++k) {
            if (!a[k].is_equal(1)) continue;
            Rotation3 C{NamedVector{0, 0, 0}, NamedVector{0, 0, 0}, NamedVector{0, 0, 0}};
            for (int column = 0; column < 3; ++column) C[(k + 1 + column) % 3][column] = 1;
            return C;
        }
        const ParameterValues values(m_);
        int across = 0;  // the letter from whose direction the axis is farthest
        for (int k = 1; k < 3; ++k)
            if (std::abs(values.number(z_.expand(a[k]))) < std::abs(values.number(z_.expand(a[across]))))
                across = k;
        NamedVector z = named(a), x{0, 0, 0};
        x[across] = 1;
        x = x - z[across] * z;
        const Named length = named(sqrt(z_.name(1 - a[across] * a[across])));
        for (Named& component : x) component = component / length;
        return transposed(Rotation3{x, cross(z, x), z});
    }

    struct Fixed {
        int frame;    ///< the moving frame in which this one is fixed; 0 for N
        Rotation3 R;  ///< converts components along this frame to components along that one
    };
    const Fixed& fixed(int f) {
        if (const auto found = fixed_.find(f); found != fixed_.end()) return found->second;
        const Skeleton::Turn& turn_step = skeleton_.frames[f];
        if (f == 0 || turn_step.by_quaternion || moves(turn_step.angle)) return fixed_[f] = {f, unity()};
        const Fixed above = fixed(turn_step.parent);
        return fixed_[f] = {above.frame, above.R * turn(turn_step.axis, turn_step.angle)};
    }
    /// The next moving frame above.
    int above(int frame) { return fixed(skeleton_.frames[frame].parent).frame; }

    std::vector<int> ancestors(int frame) {
        std::vector<int> list{frame};
        while (list.back() != 0) list.push_back(above(list.back()));
        return list;
    }

    /// The positions of the coordinates that an expression without intermediate symbols contains.
    std::set<int> coordinates_in(const ex& plain) const {
        std::set<int> found;
        for (auto at = plain.preorder_begin(); at != plain.preorder_end(); ++at) {
            if (!GiNaC::is_a<GiNaC::symbol>(*at)) continue;
            const SymbolInfo& info = m_.symbols->info(GiNaC::ex_to<GiNaC::symbol>(*at));
            if (info.kind == SymbolInfo::Kind::coordinate && info.order == 0) found.insert(info.index);
        }
        return found;
    }

    /// Sets the position of a joint, its rate, and the part of its acceleration that does not come from q''.
    /// Refuses positions that are not linear in the coordinates.
    void set_motion(TreeJoint& joint, const ex& position, const std::string& what) {
        const ex plain = z_.expand(position);
        ex rest = plain;
        joint.position = z_.name(position);
        GiNaC::exvector rate;
        joint.row.assign(static_cast<std::size_t>(m_.size()), 0);
        for (const int i : coordinates_in(plain)) {
            const ex slope = plain.diff(m_.q[i]);
            if (!GiNaC::is_a<GiNaC::numeric>(slope) || !slope.info(GiNaC::info_flags::rational))
                return refuse(
                    say("{} {} by '{}', which is no sum of coordinates with numbers as factors; use the "
                        "formalism 'lagrange' or 'kane'",
                        label_, what, shown(position)));
            joint.row[static_cast<std::size_t>(i)] = GiNaC::ex_to<GiNaC::numeric>(slope);
            rest -= slope * m_.q[i];
            rate.push_back(slope * m_.qdot[i]);
        }
        const ex first = m_.explicit_time_derivative({z_.name(rest.expand())})[0];
        rate.push_back(first);
        joint.rate = z_.name(GiNaC::add(std::move(rate)));
        joint.bias = m_.explicit_time_derivative({first})[0];
    }

    /// The seat after a further turn about `axis`; `R` converts from the frame in which the axis is given to that
    /// of the seat.
    Seat turned(const Seat& seat, const Rotation3& R, const Vector3& axis, const ex& angle) {
        Vector3 a = axis;
        ex by = angle;
        if (a[0].is_equal(-1) || a[1].is_equal(-1) || a[2].is_equal(-1)) {
            for (ex& component : a) component = -component;
            by = -by;
        }
        const Rotation3 C = axes_along(a);
        TreeJoint joint;
        joint.link.parent = seat.link;
        joint.link.R = seat.to_link * (R * C);
        joint.link.p = seat.at;
        joint.parallel = seat.link >= 0 && is_unity(joint.link.R);
        set_motion(joint, by, say("turns"));
        tree_.joints.push_back(std::move(joint));
        return {static_cast<int>(tree_.joints.size()) - 1, transposed(C), {0, 0, 0}};
    }

    /// The seat after a turn by a quaternion: three joints about x, y and z at the angle 0 (ball_joint.hpp).
    Seat turned(const Seat& seat, const Rotation3& R, const std::array<ex, 4>& e) {
        std::optional<BallJoint> ball = ball_joint(m_, e);
        if (!ball) {
            refuse(
                say("{} turns by a quaternion that is prescribed; use Euler angles, or the formalism 'routh' or "
                    "'kane'",
                    label_));
            return seat;
        }
        ball->first = static_cast<int>(tree_.joints.size());
        const Rotation3 turn{named(ball->R[0]), named(ball->R[1]), named(ball->R[2])};
        Seat next{seat.link, seat.to_link * (R * turn), seat.at};
        for (int k = 0; k < 3; ++k) {
            Vector3 axis{0, 0, 0};
            axis[k] = 1;
            const Rotation3 C = axes_along(axis);
            TreeJoint joint;
            joint.link.parent = next.link;
            joint.link.R = next.to_link * C;
            joint.link.p = next.at;
            joint.link.of_ball = true;
            joint.position = 0;
            joint.rate = ball->rate[k];
            joint.bias = ball->bias[k];
            joint.row.assign(static_cast<std::size_t>(m_.size()), 0);
            tree_.joints.push_back(std::move(joint));
            next = {ball->first + k, transposed(C), {0, 0, 0}};
        }
        tree_.balls.push_back(*std::move(ball));
        return next;
    }

    /// Refuses coordinates of a quaternion that move anything else.
    void check_alone() {
        std::vector<int> uses(static_cast<std::size_t>(m_.size()), 0);
        for (const BallJoint& ball : tree_.balls)
            for (const int a : ball.coordinate) ++uses[static_cast<std::size_t>(a)];
        for (const TreeJoint& joint : tree_.joints)
            for (std::size_t a = 0; a < joint.row.size(); ++a)
                if (uses[a] > 0 && !joint.row[a].is_zero()) ++uses[a];
        for (std::size_t a = 0; a < uses.size(); ++a)
            if (uses[a] > 1)
                refuse(
                    say("the coordinate {} of a quaternion moves more than one joint; use the formalism 'routh' "
                        "or 'kane'",
                        in_quotes(m_.q[a].get_name())));
    }

    /// The turn of a frame against the one from which it is turned; `R` converts from the latter to the seat.
    Seat turned(const Seat& seat, const Rotation3& R, const Skeleton::Turn& step) {
        return step.by_quaternion ? turned(seat, R, step.quaternion) : turned(seat, R, step.axis, step.angle);
    }

    /// Applies the turns that lead from one frame to another that does not come after it: up to the first common
    /// frame, then down.
    Seat turned_across(Seat seat, int from, int to) {
        struct Move {
            Vector3 axis;
            ex angle;  ///< if there is none, the turn is a constant rotation R
            std::optional<Rotation3> R;
        };
        std::vector<Move> moves;
        const auto push = [&](Move move) {
            if (move.R && is_unity(*move.R)) return;
            if (!move.R && !moves.empty() && !moves.back().R && same_axis(move.axis, moves.back().axis)) {
                moves.back().angle = z_.name(moves.back().angle + move.angle);
                if (moves.back().angle.is_zero()) moves.pop_back();
                return;
            }
            if (move.R && !moves.empty() && moves.back().R) {
                moves.back().R = *moves.back().R * *move.R;
                if (is_unity(*moves.back().R)) moves.pop_back();
                return;
            }
            moves.push_back(std::move(move));
        };
        const std::vector<int> up = ancestors(from), down = ancestors(to);
        const auto common = std::find_first_of(up.begin(), up.end(), down.begin(), down.end());
        const auto step = [&](int frame) -> const Skeleton::Turn& { return skeleton_.frames[frame]; };
        const auto by_quaternion = [&](int frame) { return step(frame).by_quaternion; };
        const auto last = std::find(down.begin(), down.end(), *common);
        if (std::any_of(up.begin(), common, by_quaternion) || std::any_of(down.begin(), last, by_quaternion)) {
            refuse(say(
                "{} turns by a quaternion that does not count from the body to which it is attached; let a joint "
                "place it, or use the formalism 'routh' or 'kane'",
                label_));
            return seat;
        }
        // Where both last turns begin in one fixed frame, its constant rotation is undone and done again.
        const bool meet = common != up.begin() && last != down.begin() &&
                          step(*std::prev(common)).parent == step(*std::prev(last)).parent;
        for (auto f = up.begin(); f != common; ++f) {
            push({step(*f).axis, -step(*f).angle, std::nullopt});
            if (!meet || std::next(f) != common) push({{}, 0, transposed(fixed(step(*f).parent).R)});
        }
        for (auto f = last; f != down.begin();) {
            --f;
            if (!meet || std::next(f) != last) push({{}, 0, fixed(step(*f).parent).R});
            push({step(*f).axis, step(*f).angle, std::nullopt});
        }
        Rotation3 R = unity();
        for (const Move& move : moves) {
            if (move.R) {
                R = R * *move.R;
                continue;
            }
            seat = turned(seat, R, move.axis, move.angle);
            R = unity();
        }
        seat.to_link = seat.to_link * R;
        return seat;
    }

    /// Moves the seat by a step that is not linear in the coordinates, with a joint for each of these; false if
    /// time moves it, too. `R` converts to the axes of the seat.
    bool add_curve(const Vector3& offset, Seat& seat, const Rotation3& R) {
        const std::vector<ex> step{z_.name(offset[0]), z_.name(offset[1]), z_.name(offset[2])};
        for (const ex& rate : m_.explicit_time_derivative(step))
            if (!rate.is_zero()) return false;
        const auto into_link = [&](const std::vector<ex>& v) {
            return seat.to_link * (R * NamedVector{named(v[0]), named(v[1]), named(v[2])});
        };
        const NamedVector bend = into_link(m_.time_derivative_without_acceleration(m_.time_derivative(step)));
        NamedVector way = into_link(step);
        for (int i = 0; i < m_.size(); ++i) {
            if (!z_.depends(step[0], {m_.q[i]}) && !z_.depends(step[1], {m_.q[i]}) &&
                !z_.depends(step[2], {m_.q[i]}))
                continue;
            TreeJoint joint;
            joint.link.parent = seat.link;
            joint.link.slides = true;
            joint.link.p = seat.at;
            joint.link.slide = into_link(z_.push_forward(step, {{m_.q[i], 1}}));
            joint.link.way = way;
            joint.parallel = seat.link >= 0;
            joint.position = joint.bias = 0;
            joint.rate = m_.qdot[i];
            joint.row.assign(static_cast<std::size_t>(m_.size()), 0);
            joint.row[static_cast<std::size_t>(i)] = 1;
            tree_.joints.push_back(std::move(joint));
            seat.link = static_cast<int>(tree_.joints.size()) - 1;
            seat.at = way = {0, 0, 0};
        }
        tree_.joints.back().link.bend = bend;
        return true;
    }

    /// The seat of a point, from the step that leads to it, and the moving frame along whose axes that step is
    /// given.
    std::pair<int, Seat> own_seat(int point) {
        if (point == 0) return {0, Seat{}};
        const Skeleton::Step& step = skeleton_.points[point];
        const Fixed along = fixed(step.frame);
        if (const auto found = seats_.find({along.frame, point}); found != seats_.end())
            return {along.frame, found->second};
        Seat seat = seat_of(along.frame, step.from);
        NamedVector constant{0, 0, 0};
        std::vector<std::pair<NamedVector, ex>> slides;  // direction along the frame's axes, and position
        std::array<ex, 3> rest;
        for (int k = 0; k < 3; ++k) rest[k] = moves(step.offset[k]) ? z_.expand(step.offset[k]) : step.offset[k];
        std::array<bool, 3> is_moved{};
        for (int k = 0; k < 3; ++k) is_moved[k] = moves(step.offset[k]);
        std::set<int> moving;
        for (int k = 0; k < 3; ++k)
            if (is_moved[k]) moving.merge(coordinates_in(rest[k]));
        for (const int i : moving) {
            NamedVector direction{0, 0, 0};
            bool any = false;
            for (int k = 0; k < 3; ++k) {
                if (!is_moved[k] || !rest[k].has(m_.q[i])) continue;
                const ex slope = rest[k].diff(m_.q[i]);
                if (moves(slope)) {
                    if (curves_ == Curves::allowed && add_curve(step.offset, seat, along.R)) {
                        seats_[{along.frame, point}] = seat;
                        return {along.frame, seat};
                    }
                    refuse(say(
                        "{} is on a point shifted by '{}', which is not linear in the coordinates; place it by "
                        "frames or joints, or use the formalism 'lagrange' or 'kane'",
                        label_, shown(step.offset[k])));
                    return {along.frame, seat};
                }
                direction[k] = named(slope);
                rest[k] = (rest[k] - slope * m_.q[i]).expand();
                any = true;
            }
            if (any) slides.emplace_back(direction, m_.q[i]);
        }
        for (int k = 0; k < 3; ++k) {
            if (!moves(rest[k])) {
                constant[k] = named(rest[k]);
                continue;
            }
            NamedVector direction{0, 0, 0};
            direction[k] = 1;
            slides.emplace_back(direction, z_.name(rest[k]));
        }
        const auto into_link = [&](const NamedVector& v) { return seat.to_link * (along.R * v); };
        seat.at = seat.at + into_link(constant);
        for (const auto& [direction, position] : slides) {
            TreeJoint joint;
            joint.link.parent = seat.link;
            joint.link.slides = true;
            joint.link.p = seat.at;
            joint.link.slide = into_link(direction);
            joint.parallel = seat.link >= 0;
            set_motion(joint, position, say("is shifted"));
            tree_.joints.push_back(std::move(joint));
            seat.link = static_cast<int>(tree_.joints.size()) - 1;
            seat.at = {0, 0, 0};
        }
        seats_[{along.frame, point}] = seat;
        return {along.frame, seat};
    }

    /// The seat of a point as a part of the frame.
    Seat seat_of(int frame, int point) {
        if (const auto found = seats_.find({frame, point}); found != seats_.end()) return found->second;
        const auto [own, seat] = own_seat(point);
        if (own == frame) return seat;
        const std::vector<int> line = ancestors(frame);
        Seat result;
        if (std::find(line.begin(), line.end(), own) != line.end()) {
            const int before = above(frame);
            const Skeleton::Turn& step = skeleton_.frames[frame];
            result = turned(seat_of(before, point), fixed(step.parent).R, step);
        } else {
            result = turned_across(seat, own, frame);
        }
        return seats_[{frame, point}] = result;
    }

    void add(const MassElement& body) {
        const Fixed along = fixed(body.rotation ? body.frame : 0);
        const Seat seat = body.rotation ? seat_of(along.frame, body.point) : own_seat(body.point).second;
        if (seat.link < 0) {
            tree_.findings.at_rest.push_back(body.origin.name);
            return;
        }
        const auto at_same_point = [&](const Seat& other) {
            return other.link == seat.link && other.at[0].e.is_equal(seat.at[0].e) &&
                   other.at[1].e.is_equal(seat.at[1].e) && other.at[2].e.is_equal(seat.at[2].e);
        };
        if (std::any_of(of_masses_.begin(), of_masses_.end(), at_same_point))
            tree_.findings.merged.push_back(body.origin.name);
        of_masses_.push_back(seat);
        RigidBody<Named> added;
        const Named m = named(body.mass);
        if (body.rotation) {
            const std::array<ex, 6> I = central_inertia(body, z_);
            const ex half = GiNaC::numeric(1, 2);
            for (int k = 0; k < 3; ++k) added.second[k] = named(half * (I[(k + 1) % 3] + I[(k + 2) % 3] - I[k]));
            for (int k = 3; k < 6; ++k) added.second[k] = named(-I[k]);
            added.second = congruent(seat.to_link * along.R, added.second);
        }
        added.mass = m;
        added = shifted(added, seat.at);
        RigidBody<Named>& whole = tree_.joints[seat.link].link.body;
        whole = whole + added;
    }

    /// Gives the rotor to a joint that moves with its coordinate alone.
    void add(const Rotor& rotor) {
        const auto moves_alone = [&](const TreeJoint& joint) {
            for (std::size_t a = 0; a < joint.row.size(); ++a)
                if (joint.row[a].is_zero() == (static_cast<int>(a) == rotor.coordinate)) return false;
            return true;
        };
        const auto joint = std::find_if(tree_.joints.begin(), tree_.joints.end(), moves_alone);
        if (joint == tree_.joints.end())
            return refuse(say("no joint moves with {} alone, so that none has its armature",
                              in_quotes(m_.q[rotor.coordinate].get_name())));
        const GiNaC::numeric& s = joint->row[static_cast<std::size_t>(rotor.coordinate)];
        joint->rotor = z_.name(joint->rotor + rotor.inertia / (s * s));
        tree_.rotors.push_back(rotor);
    }

    const Mechanism& m_;
    const Skeleton& skeleton_;
    const Curves curves_;
    Intermediates& z_;
    const std::vector<GiNaC::symbol> moving_ = m_.moving();
    JointTree tree_;
    std::string label_;
    std::optional<Obstacle> obstacle_;
    std::map<int, Fixed> fixed_;
    std::map<std::pair<int, int>, Seat> seats_;
    std::vector<Seat> of_masses_;
};

}  // namespace

Possible<JointTree> joint_tree(const Mechanism& m) {
    Possible<JointTree> best = Finder(m, m.skeleton, Curves::refused).find();
    const auto joints = [](const Possible<JointTree>& tree) {
        return tree.exists() ? static_cast<int>(tree.value().joints.size()) : std::numeric_limits<int>::max();
    };
    for (const TurningFrames turns : {TurningFrames::found, TurningFrames::none}) {
        if (joints(best) <= m.size()) break;
        const std::optional<Skeleton> skeleton = with_links(m, turns);
        if (!skeleton) break;
        Possible<JointTree> other = Finder(m, *skeleton, Curves::allowed).find();
        if (joints(other) >= joints(best)) continue;
        JointTree tree = std::move(other).value();
        tree.findings.in_positions = true;
        best = std::move(tree);
    }
    return best;
}

}  // namespace alembert

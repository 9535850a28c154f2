// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/lower/link_frames.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "program/interpret.hpp"

namespace alembert {

namespace {

constexpr double smallest_sine =
    0.02;  // the least angle between axes that are not parallel; division by its sine loses digits
constexpr std::size_t most_places = 6;  // the most places of a link's origin that are compared

using Vector = Triple<Symbolic>;

class Frames {
public:
    Frames(Program& program, BodyTree<Symbolic> tree)
        : p_(program), tree_(std::move(tree)), children_(tree_.links.size()), weight_(tree_.links.size(), 1) {
        for (int j = tree_.size() - 1; j >= 0; --j)
            if (const int parent = link(j).parent; parent >= 0) {
                children_[parent].insert(children_[parent].begin(), j);
                weight_[parent] += weight_[j];
            }
    }

    BodyTree<Symbolic> made() && {
        for (int j = 0; j < tree_.size(); ++j) turn(j);
        shift();
        return std::move(tree_);
    }

private:
    TreeLink<Symbolic>& link(int j) { return tree_.links[static_cast<std::size_t>(j)]; }

    /// Whether the frame of a link may be moved: it turns with the link, which turns about its z axis.
    static bool turns(const TreeLink<Symbolic>& l) { return !l.slides && !l.still; }

    /// Whether both links turn, and R between them consists of numbers by which can be divided without loss.
    bool is_hinge(int k) {
        const TreeLink<Symbolic>& l = link(k);
        if (!turns(l) || l.parent < 0 || !turns(link(l.parent))) return false;
        for (const Vector& row : l.R)
            for (const Symbolic& entry : row)
                if (p_[entry.node(p_)].depends != 0) return false;
        if (l.R[0][2].is_zero() && l.R[1][2].is_zero()) return true;
        return std::hypot(value(l.R[0][2]), value(l.R[1][2])) > smallest_sine;
    }

    double value(const Symbolic& constant) { return value(constant.node(p_)); }
    double value(int id) {
        const Node& node = p_[id];
        const auto arg = [&](std::size_t k) { return value(node.args[k]); };
        switch (node.op) {
            case Op::number:
                return real_of<double>(node.number);
            case Op::pi:
                return M_PI;
            case Op::sin:
                return std::sin(arg(0));
            case Op::cos:
                return std::cos(arg(0));
            case Op::sqrt:
                return std::sqrt(arg(0));
            case Op::sum: {
                double sum = real_of<double>(node.number);
                for (std::size_t k = 0; k < node.args.size(); ++k)
                    sum += real_of<double>(node.coefficients[k]) * arg(k);
                return sum;
            }
            case Op::product: {
                double product = 1;
                for (std::size_t k = 0; k < node.args.size(); ++k) product *= std::pow(arg(k), node.exponents[k]);
                return product;
            }
            default:
                return std::numeric_limits<double>::quiet_NaN();
        }
    }

    Symbolic root(const Symbolic& x) { return {p_, p_.call(Op::sqrt, {x.node(p_)})}; }

    struct Turn {
        Symbolic cosine = 1, sine = 0;
    };

    /// The turn a of the frame with z = Rz(a) Rx(b) e_z; none if z is e_z.
    Turn turn_of(const Vector& z) {
        if (z[0].is_zero()) return {};
        if (z[1].is_zero()) return {0, value(z[0]) > 0 ? 1 : -1};
        const Symbolic sign = value(z[1]) > 0 ? -1 : 1, sine = sign * root(z[0] * z[0] + z[1] * z[1]);
        return {-z[1] / sine, z[0] / sine};
    }

    /// Turns the frame of link j by a for the child that carries most links, and by c for the last factor of its
    /// own R.
    void turn(int j) {
        TreeLink<Symbolic>& own = link(j);
        if (!turns(own) || own.of_ball) return;
        Turn offset;
        if (is_hinge(j)) {
            const Matrix<Symbolic> columns = transposed(own.R);
            const Turn a = turn_of(columns[2]);
            const Vector first{a.cosine, a.sine, 0}, second = cross(columns[2], first);
            offset = {dot(first, columns[0]), dot(second, columns[0])};
            own.R = transposed(Matrix<Symbolic>{first, second, columns[2]});
            if (first[0].number() && cln::equal(*first[0].number(), 1))
                own.about_x = !own.R[1][1].is_zero() && !own.R[2][1].is_zero();
        }
        int main = -1;
        for (const int k : children_[static_cast<std::size_t>(j)])
            if (is_hinge(k) && (main < 0 || weight_[k] > weight_[main])) main = k;
        if (main >= 0) {
            const Turn a = turn_of({link(main).R[0][2], link(main).R[1][2], link(main).R[2][2]});
            own.body.first = turned_back(a.cosine, a.sine, own.body.first);
            own.body.second = turned_about_z(a.cosine, -a.sine, own.body.second);
            for (const int k : children_[static_cast<std::size_t>(j)]) {
                Matrix<Symbolic> columns = transposed(link(k).R);
                for (Vector& column : columns) column = turned_back(a.cosine, a.sine, column);
                link(k).R = transposed(columns);
                link(k).p = turned_back(a.cosine, a.sine, link(k).p);
                if (k == main) link(k).R[0][2] = Symbolic(0);
            }
            offset = {offset.cosine * a.cosine - offset.sine * a.sine,
                      offset.sine * a.cosine + offset.cosine * a.sine};
        }
        if (offset.cosine.number() && offset.sine.number()) {  // these are nearly always quarter turns
            const Symbolic c = own.cosine, s = own.sine;
            own.cosine = offset.cosine * c - offset.sine * s;
            own.sine = offset.sine * c + offset.cosine * s;
        } else {
            const Symbolic angle =
                own.angle + Symbolic(p_, p_.call(Op::atan2, {offset.sine.node(p_), offset.cosine.node(p_)}));
            own.cosine = {p_, p_.call(Op::cos, {angle.node(p_)})};
            own.sine = {p_, p_.call(Op::sin, {angle.node(p_)})};
        }
    }

    /// A shift of an origin along z, and the entry of its own p that becomes zero by it.
    struct Place {
        Symbolic d = 0;
        int zero = -1;
        double cost = 0;  ///< number of entries of p of all links attached to it
    };

    Vector arm(int k, const Place& own, const Symbolic& parent) {
        const TreeLink<Symbolic>& l = link(k);
        Vector p = l.p;
        if (turns(l))
            for (int i = 0; i < 3; ++i) p[i] = i == own.zero ? Symbolic(0) : p[i] + own.d * l.R[i][2];
        p[2] = p[2] - parent;
        return p;
    }
    static double entries(const Vector& p) {
        return static_cast<double>(
            std::count_if(p.begin(), p.end(), [](const Symbolic& x) { return !x.is_zero(); }));
    }

    const Place& best(int k, const Symbolic& parent) {
        const std::vector<Place>& list = places_[static_cast<std::size_t>(k)];
        return *std::min_element(list.begin(), list.end(), [&](const Place& a, const Place& b) {
            return entries(arm(k, a, parent)) + a.cost < entries(arm(k, b, parent)) + b.cost;
        });
    }

    /// Finds the possible places of each origin from the tips inwards, then chooses the best of these outwards.
    void shift() {
        places_.resize(tree_.links.size());
        for (int j = tree_.size() - 1; j >= 0; --j) {
            std::vector<Place>& list = places_[static_cast<std::size_t>(j)];
            list.emplace_back();
            const TreeLink<Symbolic>& l = link(j);
            if (turns(l) && !l.of_ball) {
                if (is_hinge(j))
                    for (int i = 0; i < 2; ++i)
                        if (!l.p[i].is_zero() && std::abs(value(l.R[i][2])) > smallest_sine)
                            list.push_back({-l.p[i] / l.R[i][2], i});
                for (const int k : children_[static_cast<std::size_t>(j)])
                    for (const Place& child : places_[static_cast<std::size_t>(k)])
                        if (const Symbolic d = arm(k, child, 0)[2]; list.size() < most_places && !d.is_zero())
                            list.push_back({d});
            }
            for (Place& place : list)
                for (const int k : children_[static_cast<std::size_t>(j)]) {
                    const Place& child = best(k, place.d);
                    place.cost += child.cost + entries(arm(k, child, place.d));
                }
        }
        std::vector<Symbolic> moved(tree_.links.size(), 0);
        for (int j = 0; j < tree_.size(); ++j) {
            TreeLink<Symbolic>& l = link(j);
            const Symbolic parent = l.parent < 0 ? Symbolic(0) : moved[static_cast<std::size_t>(l.parent)];
            const Place place = best(j, parent);
            if (l.parent >= 0) l.p = arm(j, place, parent);
            moved[static_cast<std::size_t>(j)] = place.d;
            if (!place.d.is_zero()) l.body = shifted(l.body, Vector{0, 0, -place.d});
        }
    }

    Program& p_;
    BodyTree<Symbolic> tree_;
    std::vector<std::vector<int>> children_;
    std::vector<int> weight_;  // number of links attached to it, itself included
    std::vector<std::vector<Place>> places_;
};

}  // namespace

BodyTree<Symbolic> reframed(Program& program, BodyTree<Symbolic> tree) {
    return Frames(program, std::move(tree)).made();
}

}  // namespace alembert

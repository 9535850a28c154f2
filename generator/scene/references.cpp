// SPDX-License-Identifier: GPL-2.0-or-later
// Depth-first search with an explicit stack: a chain of definitions may be longer than the machine's stack.
#include "scene/references.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/language/say.hpp"
#include "scene/functions.hpp"
#include "scene/text.hpp"

namespace alembert {
namespace {

using DeclaredAs = Declared::Kind;

constexpr int most_defined_levels = 2000;

struct Node {
    DeclaredAs kind;
    std::size_t index;
    const Name* name;
    struct Target {
        std::size_t node;
        bool is_inside;  ///< an expression of the node, and no place or frame from which it is counted
    };
    std::vector<Target> targets = {};
    int weight = 1;  ///< levels of nesting in its own expressions
    enum class State { fresh, open, done } state = State::fresh;
    int levels = 0;
    bool in_circle = false;
};

int levels_of(const Tree& tree) {
    int most = 0;
    for (const TreePtr& arg : tree.args) most = std::max(most, levels_of(*arg));
    return most + 1;
}

class Graph {
public:
    explicit Graph(const Scene& scene) : scene_(scene) {
        add(scene.parameters, DeclaredAs::parameter, values_);
        add(scene.inputs, DeclaredAs::input, values_);
        add(scene.definitions, DeclaredAs::definition, values_);
        add(scene.speeds, DeclaredAs::speed, values_);
        add(scene.frames, DeclaredAs::frame, frames_);
        add(scene.bodies, DeclaredAs::body, frames_);
        add(scene.points, DeclaredAs::point, points_);
        add(scene.particles, DeclaredAs::particle, points_);
        add_centres();
        connect();
    }

    References follow(std::vector<Diagnostic>& diagnostics) {
        for (std::size_t start = 0; start < nodes_.size(); ++start) search(start, diagnostics);
        return std::move(references_);
    }

private:
    using Index = std::unordered_map<std::string, std::size_t>;
    const Scene& scene_;
    std::vector<Node> nodes_;
    Index values_, frames_, points_;
    Index centres_;  ///< the mass centres, by body
    References references_;

    void add_centres() {
        for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
            points_.emplace(scene_.bodies[i].point().text, nodes_.size());
            centres_.emplace(scene_.bodies[i].name.text, nodes_.size());
            nodes_.push_back({DeclaredAs::body, i, &scene_.bodies[i].point()});
        }
    }

    template <typename Item>
    void add(const std::vector<Item>& items, DeclaredAs kind, Index& index) {
        for (std::size_t i = 0; i < items.size(); ++i) {
            const std::string& name = items[i].name.text;
            const bool is_fixed = (&index == &frames_ && name == "N") || (&index == &points_ && name == "O");
            if (!is_fixed) index.emplace(name, nodes_.size());
            nodes_.push_back({kind, i, &items[i].name});
        }
    }

    /// Records what each node refers to. The order is that in which the nodes were made.
    void connect() {
        std::size_t n = 0;
        for (const Parameter& p : scene_.parameters) look(nodes_[n++], p.value);
        for (const Input& i : scene_.inputs) look(nodes_[n++], i.value);
        for (const Definition& d : scene_.definitions) look(nodes_[n++], d.value);
        for (const Speed& s : scene_.speeds) look(nodes_[n++], s.form);
        for (const Frame& frame : scene_.frames) {
            Node& node = nodes_[n++];
            base(node, frames_, frame.parent.text);
            for (const Rotation& rotation : frame.rotations) {
                look(node, rotation.angle);
                for (const Expression& component : rotation.axis.component) look(node, component);
            }
        }
        for (const Body& body : scene_.bodies) {
            Node& node = nodes_[n++];
            if (body.joint)
                look(node, scene_.joints[*body.joint], frames_);
            else
                base(node, frames_, body.frame.text);
        }
        for (const Point& point : scene_.points) look(nodes_[n++], point.position);
        for (const Particle& particle : scene_.particles) look(nodes_[n++], particle.position);
        for (const Body& body : scene_.bodies) {
            Node& node = nodes_[n++];
            if (body.joint)
                look(node, scene_.joints[*body.joint], centres_);
            else
                look(node, body.position);
        }
    }

    /// A body that a joint places refers to the other body of the joint.
    void look(Node& node, const Joint& joint, const Index& index) {
        const Joint::Side& other = *joint.places_child ? joint.parent : joint.child;
        base(node, frames_, other.body.text);
        base(node, index, other.body.text);
        for (const Joint::Side* side : {&joint.parent, &joint.child}) {
            for (const Expression& component : side->point.component) look(node, component);
            for (const Rotation& rotation : side->rotate) {
                look(node, rotation.angle);
                for (const Expression& component : rotation.axis.component) look(node, component);
            }
        }
        for (const Expression& component : joint.axis.axis.component) look(node, component);
        look(node, joint.pitch);
        for (const Name& coordinate : joint.coordinates) target(node, values_, coordinate.text);
    }

    static void target(Node& node, const Index& index, const std::string& name, bool is_inside = true) {
        if (const auto found = index.find(name); found != index.end())
            node.targets.push_back({found->second, is_inside});
    }
    static void base(Node& node, const Index& index, const std::string& name) { target(node, index, name, false); }

    void look(Node& node, const Position& position) {
        base(node, points_, position.from.text);
        base(node, frames_, position.axes.text);
        for (const Expression& component : position.offset.component) look(node, component);
    }

    void look(Node& node, const Expression& expression) {
        if (!expression.tree) return;
        node.weight = std::max(node.weight, levels_of(*expression.tree));
        look(node, *expression.tree);
    }

    void look(Node& node, const Tree& tree) {
        if (tree.kind == Tree::Kind::name) target(node, values_, tree.text);
        const Function* const function = tree.kind == Tree::Kind::call ? find_function(tree.text) : nullptr;
        const auto takes = function ? function->takes : Function::Takes::scalars;
        for (const TreePtr& arg : tree.args)
            if (takes == Function::Takes::points)
                target(node, points_, arg->text);
            else if (takes == Function::Takes::frames)
                target(node, frames_, arg->text);
            else
                look(node, *arg);
    }

    void search(std::size_t start, std::vector<Diagnostic>& diagnostics) {
        if (nodes_[start].state != Node::State::fresh) return;
        // A node, and the next of its targets to visit.
        std::vector<std::pair<std::size_t, std::size_t>> path{{start, 0}};
        nodes_[start].state = Node::State::open;
        while (!path.empty()) {
            const std::size_t here = path.back().first;
            if (path.back().second < nodes_[here].targets.size()) {
                const std::size_t next = nodes_[here].targets[path.back().second++].node;
                if (nodes_[next].state == Node::State::open) {
                    tell_circle(path, next, diagnostics);
                } else if (nodes_[next].state == Node::State::fresh) {
                    nodes_[next].state = Node::State::open;
                    path.emplace_back(next, 0);
                }
                continue;
            }
            leave(here, diagnostics);
            path.pop_back();
        }
    }

    void leave(std::size_t here, std::vector<Diagnostic>& diagnostics) {
        Node& node = nodes_[here];
        node.state = Node::State::done;
        int levels = node.weight, deepest = 0;
        for (const auto& [next, is_inside] : node.targets) {
            deepest = std::max(deepest, nodes_[next].levels);
            levels = std::max(levels, nodes_[next].levels + (is_inside ? node.weight : 1));
        }
        node.levels = std::min(levels, most_defined_levels + 1);
        if (node.levels > most_defined_levels && deepest <= most_defined_levels)
            diagnostics.push_back(
                {node.name->place,
                 say("{} depends on other names through more than {} levels, which are followed one inside "
                     "another in "
                     "limited memory; define it by fewer names in a row, or count it from a nearer point or frame",
                     in_quotes(node.name->text), most_defined_levels)});
        if ((node.kind == DeclaredAs::definition || node.kind == DeclaredAs::speed) && !node.in_circle)
            references_.definitions.emplace_back(node.kind, node.index);
    }

    void tell_circle(const std::vector<std::pair<std::size_t, std::size_t>>& path, std::size_t closing,
                     std::vector<Diagnostic>& diagnostics) {
        std::vector<std::size_t> circle;
        for (auto step = path.rbegin(); step != path.rend(); ++step) {
            circle.push_back(step->first);
            if (step->first == closing) break;
        }
        std::reverse(circle.begin(), circle.end());
        if (std::all_of(circle.begin(), circle.end(), [&](std::size_t k) { return nodes_[k].in_circle; })) return;
        for (const std::size_t k : circle) nodes_[k].in_circle = true;
        std::rotate(circle.begin(),
                    std::min_element(circle.begin(), circle.end(),
                                     [&](std::size_t a, std::size_t b) {
                                         return nodes_[a].name->place < nodes_[b].name->place;
                                     }),
                    circle.end());
        const Node& first = nodes_[circle.front()];
        std::string chain;
        for (std::size_t i = 0; i < circle.size(); ++i) {
            if (i == 8 && circle.size() > 10) {
                chain += "… → ";
                i = circle.size() - 1;
            }
            chain += escaped(nodes_[circle[i]].name->text) + " → ";
        }
        diagnostics.push_back({first.name->place, meaning(circle) + ": " + chain + escaped(first.name->text)});
    }

    std::string meaning(const std::vector<std::size_t>& circle) const {
        std::set<DeclaredAs> kinds;
        for (const std::size_t k : circle) kinds.insert(nodes_[k].kind);
        const std::string first = in_quotes(nodes_[circle.front()].name->text);
        if (kinds == std::set{DeclaredAs::definition}) return say("definitions in a circle");
        if (kinds == std::set{DeclaredAs::speed}) return say("speeds in a circle");
        if (kinds == std::set{DeclaredAs::parameter}) return say("parameters in a circle");
        if (kinds == std::set{DeclaredAs::input}) return say("inputs in a circle");
        if (kinds == std::set{DeclaredAs::frame}) return say("the frame {} is its own ancestor", first);
        const bool is_place = std::all_of(kinds.begin(), kinds.end(), [](DeclaredAs kind) {
            return kind == DeclaredAs::point || kind == DeclaredAs::particle || kind == DeclaredAs::body;
        });
        if (is_place) return say("{} is where it is by itself", first);
        return say("{} is determined by itself", first);
    }
};

}  // namespace

References follow(const Scene& scene, std::vector<Diagnostic>& diagnostics) {
    return Graph(scene).follow(diagnostics);
}

}  // namespace alembert

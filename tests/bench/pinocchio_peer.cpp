// SPDX-License-Identifier: MIT
// Times dynamics of robots and their derivatives: ours, Pinocchio's functions, and the code that CppADCodeGen
// writes from these (pinocchio_code.cpp). pinocchio.sh compiles this.
//
//   pinocchio_peer ROBOT fixed|floating ROUNDS OURS.so [FUNCTION NAME THEIRS.so]…      prints JSON
//
// Results at all states agree to 1e-9 of the largest before anything is timed; then the contenders take turns, and
// each one's time is the least of all rounds.
#include <dlfcn.h>
#include <time.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iostream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include "alembert/native/abi.hpp"
#include "pinocchio_robot.hpp"

namespace {

using namespace alembert;

using Vector = Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int states = 16;
constexpr double agreement = 1e-9, slice = 5e-3;  // of the largest value; seconds of a contender's turn

double seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Ours {
    const alembert_solver_table* table;
    const alembert_derivative_table* derivatives;
    const alembert_function_table* functions;
    std::vector<double> par;

    explicit Ours(const char* path) {
        void* const library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
        if (library == nullptr) throw std::runtime_error(dlerror());
        table = reinterpret_cast<const alembert_solver_table* (*)()>(dlsym(library, "alembert_solver"))();
        derivatives =
            reinterpret_cast<const alembert_derivative_table* (*)()>(dlsym(library, "alembert_derivatives"))();
        functions = reinterpret_cast<const alembert_function_table* (*)()>(dlsym(library, "alembert_functions"))();
        par.assign(table->parameter_values, table->parameter_values + table->parameters);
        par.resize(par.size() + static_cast<std::size_t>(table->constants));
        table->prepare(par.data());
    }
    const alembert_named_function& named(const std::string& name) const {
        for (int k = 0; k < functions->count; ++k)
            if (functions->list[k].name == name) return functions->list[k];
        throw std::runtime_error("there is no function " + name);
    }
};

/// A state in our order of coordinates and in theirs.
struct At {
    std::vector<double> state, rate;
    Vector q, v, tau, a;
};

/// The position in their vectors of each of our coordinates.
std::vector<int> places(const Model& model, const alembert_solver_table& table) {
    const std::vector<std::string> base{"x", "y", "z", "yaw", "pitch", "roll"};
    std::vector<int> result;
    for (int i = 0; i < table.coordinates; ++i) {
        const std::string name = table.coordinate_names[i];
        int place = -1;
        if (name.rfind("floating_base_", 0) == 0 || name.rfind("base_", 0) == 0)
            for (std::size_t k = 0; k < base.size(); ++k)
                if (name.substr(name.rfind('_') + 1) == base[k]) place = static_cast<int>(k);
        if (place < 0 && model.existJointName(name)) place = model.joints[model.getJointId(name)].idx_v();
        if (place < 0) throw std::runtime_error("Pinocchio has no coordinate " + name);
        result.push_back(place);
    }
    return result;
}

using TheirCode = void (*)(const double* const* in, double* const* out, const void* atomics);

TheirCode loaded(const std::string& path, const std::string& function) {
    void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) throw std::runtime_error(dlerror());
    return reinterpret_cast<TheirCode>(dlsym(library, (function + "_forward_zero").c_str()));
}

struct Contender {
    std::string name;
    std::function<void(int k)> call;
    std::function<std::vector<double>(int k)> result;  // in our order, row by row; after a call for the same state
};

struct Comparison {
    std::string function;
    std::vector<Contender> list;  // ours first
};

class Contest {
public:
    Contest(const std::string& path, bool floats, const char* ours)
        : robot_(robot_of(path, floats)), ours_(ours), n_(model_.nv) {
        place_ = places(model_, *ours_.table);
        std::mt19937_64 random(1);
        std::uniform_real_distribution<double> turn(-1.2, 1.2), rate(-1, 1);
        for (int k = 0; k < states; ++k) {
            At at{std::vector<double>(2 * n_),
                  std::vector<double>(2 * n_),
                  Vector(n_),
                  Vector(n_),
                  Vector(n_),
                  Vector(n_)};
            for (int i = 0; i < n_; ++i) {
                at.q[place_[i]] = at.state[i] = turn(random);
                at.v[place_[i]] = at.state[n_ + i] = at.rate[i] = rate(random);
                at.a[place_[i]] = at.rate[n_ + i] = rate(random);
            }
            at.tau = -damping_.cwiseProduct(at.v);
            at_.push_back(std::move(at));
        }
        Da_ = Dq_ = Dv_ = tau_q_ = tau_v_ = tau_a_ = Eigen::MatrixXd::Zero(n_, n_);
        out_.resize(static_cast<std::size_t>(4 * n_ * n_));
        theirs_.resize(static_cast<std::size_t>(3 * n_ * n_ + n_));
    }

    std::vector<Comparison> comparisons() {
        return {{"forward", {ours_forward(), plain_forward()}},
                {"inverse", {ours_inverse(), plain_inverse()}},
                {"mass", {ours_mass(), plain_mass()}},
                {"forward_jacobian", {ours_forward_jacobian(), plain_forward_jacobian()}},
                {"inverse_jacobian", {ours_inverse_jacobian(), plain_inverse_jacobian()}}};
    }

    Contender generated(const std::string& function, const std::string& name, const std::string& path) {
        const TheirCode code = loaded(path, function);
        input_.resize(static_cast<std::size_t>(3 * n_));
        const auto call = [this, code](int k) {
            const At& at = at_[k];
            const Vector* const last = code_takes_a_ ? &at.a : &at.tau;
            std::memcpy(input_.data(), at.q.data(), sizeof(double) * n_);
            std::memcpy(input_.data() + n_, at.v.data(), sizeof(double) * n_);
            std::memcpy(input_.data() + 2 * n_, last->data(), sizeof(double) * n_);
            const double* in[] = {input_.data()};
            double* out[] = {theirs_.data()};
            code(in, out, nullptr);
        };
        const bool by_a = function.rfind("forward", 0) != 0;
        return {name,
                [this, call, by_a](int k) {
                    code_takes_a_ = by_a;
                    call(k);
                },
                [this, function](int k) { return ours_from_generated(function, k); }};
    }

    const Ours& ours() const { return ours_; }
    int size() const { return n_; }

private:
    Contender ours_forward() {
        return {"ours", [this](int k) { ours_.table->rhs(0, at_[k].state.data(), ours_.par.data(), out_.data()); },
                [this](int) { return std::vector<double>(out_.begin() + n_, out_.begin() + 2 * n_); }};
    }
    Contender ours_named(const std::string& name) {
        const alembert_named_function& f = ours_.named(name);
        return {"ours",
                [this, &f](int k) {
                    f.call(0, at_[k].state.data(), at_[k].rate.data(), ours_.par.data(), out_.data());
                },
                [this, &f](int) { return std::vector<double>(out_.begin(), out_.begin() + f.rows * f.columns); }};
    }
    Contender ours_inverse() { return ours_named("inverse"); }
    Contender ours_mass() { return ours_named("mass"); }
    Contender ours_inverse_jacobian() {
        const alembert_named_function &f = ours_.named("inverse_jacobian"), &mass = ours_.named("mass");
        return {"ours",
                [this, &f, &mass](int k) {
                    f.call(0, at_[k].state.data(), at_[k].rate.data(), ours_.par.data(), out_.data());
                    mass.call(0, at_[k].state.data(), at_[k].rate.data(), ours_.par.data(),
                              out_.data() + 2 * n_ * n_);
                },
                [this](int) {
                    std::vector<double> list;
                    for (int i = 0; i < n_; ++i)
                        for (int j = 0; j < 3 * n_; ++j)
                            list.push_back(j < 2 * n_ ? out_[i * 2 * n_ + j]
                                                      : out_[2 * n_ * n_ + i * n_ + j - 2 * n_]);
                    return list;
                }};
    }
    Contender ours_forward_jacobian() {
        return {
            "ours",
            [this](int k) { ours_.derivatives->jacobian(0, at_[k].state.data(), ours_.par.data(), out_.data()); },
            [this](int) {
                std::vector<double> list(static_cast<std::size_t>(2 * n_ * n_));
                for (int e = 0; e < ours_.derivatives->entries; ++e) {
                    const int row = ours_.derivatives->rows[e] - n_;
                    if (row >= 0 && row < n_) list[row * 2 * n_ + ours_.derivatives->columns[e]] = out_[e];
                }
                return list;
            }};
    }

    Contender plain_forward() {
        return {"Pinocchio", [this](int k) { pinocchio::aba(model_, data_, at_[k].q, at_[k].v, at_[k].tau); },
                [this](int) { return vector_in_our_order(data_.ddq); }};
    }
    Contender plain_inverse() {
        return {"Pinocchio", [this](int k) { pinocchio::rnea(model_, data_, at_[k].q, at_[k].v, at_[k].a); },
                [this](int k) { return vector_in_our_order(data_.tau + damping_.cwiseProduct(at_[k].v)); }};
    }
    Contender plain_mass() {
        return {"Pinocchio", [this](int k) { pinocchio::crba(model_, data_, at_[k].q); },
                [this](int) {
                    return in_our_order(std::vector<Eigen::MatrixXd>{data_.M.selfadjointView<Eigen::Upper>()});
                }};
    }
    Contender plain_forward_jacobian() {
        return {"Pinocchio",
                [this](int k) {
                    pinocchio::computeABADerivatives(model_, data_, at_[k].q, at_[k].v, at_[k].tau, Dq_, Dv_, Da_);
                },
                [this](int) {
                    const Eigen::MatrixXd inverse = Eigen::MatrixXd(Da_.selfadjointView<Eigen::Upper>());
                    return in_our_order({Dq_, Dv_ - inverse * damping_.asDiagonal()});
                }};
    }
    Contender plain_inverse_jacobian() {
        return {"Pinocchio",
                [this](int k) {
                    pinocchio::computeRNEADerivatives(model_, data_, at_[k].q, at_[k].v, at_[k].a, tau_q_, tau_v_,
                                                      tau_a_);
                },
                [this](int) {
                    return in_our_order({tau_q_, tau_v_ + Eigen::MatrixXd(damping_.asDiagonal()),
                                         Eigen::MatrixXd(tau_a_.selfadjointView<Eigen::Upper>())});
                }};
    }

    std::vector<double> ours_from_generated(const std::string& function, int k) const {
        const auto matrix = [&](int which) -> Eigen::MatrixXd {
            return Eigen::Map<const RowMajor>(theirs_.data() + which * n_ * n_, n_, n_);
        };
        const Vector vector = Eigen::Map<const Vector>(theirs_.data(), n_);
        if (function == "forward") return vector_in_our_order(vector);
        if (function == "inverse") return vector_in_our_order(vector + damping_.cwiseProduct(at_[k].v));
        if (function == "mass")
            return in_our_order(std::vector<Eigen::MatrixXd>{matrix(0).selfadjointView<Eigen::Upper>()});
        if (function == "inverse_jacobian")
            return in_our_order({matrix(0), matrix(1) + Eigen::MatrixXd(damping_.asDiagonal()),
                                 Eigen::MatrixXd(matrix(2).selfadjointView<Eigen::Upper>())});
        // d q'' / d q' at a given torque lacks the part of the dampers, which is M^-1 times their constants.
        DataOf<double> data(model_);
        Eigen::MatrixXd inverse = pinocchio::computeMinverse(model_, data, at_[k].q);
        inverse.triangularView<Eigen::StrictlyLower>() = inverse.transpose();
        return in_our_order({matrix(0), matrix(1) - inverse * damping_.asDiagonal()});
    }

    std::vector<double> vector_in_our_order(const Vector& v) const {
        std::vector<double> list;
        for (int i = 0; i < n_; ++i) list.push_back(v[place_[i]]);
        return list;
    }
    std::vector<double> in_our_order(const std::vector<Eigen::MatrixXd>& blocks) const {
        std::vector<double> list;
        for (int i = 0; i < n_; ++i)
            for (const Eigen::MatrixXd& block : blocks)
                for (int j = 0; j < n_; ++j) list.push_back(block(place_[i], place_[j]));
        return list;
    }

    Robot robot_;
    const Model& model_ = robot_.model;
    const Vector& damping_ = robot_.damping;
    DataOf<double> data_{model_};
    Ours ours_;
    int n_;
    std::vector<int> place_;
    std::vector<At> at_;
    Eigen::MatrixXd Dq_, Dv_, Da_;
    Eigen::MatrixXd tau_q_, tau_v_, tau_a_;  // zeros stay where computeRNEADerivatives writes nothing
    std::vector<double> out_, theirs_, input_;
    bool code_takes_a_ = false;
};

/// The largest difference of the results, relative to the largest of ours.
double difference(const Contender& ours, const Contender& theirs) {
    double worst = 0;
    for (int k = 0; k < states; ++k) {
        ours.call(k);
        const std::vector<double> a = ours.result(k);
        theirs.call(k);
        const std::vector<double> b = theirs.result(k);
        double largest = 0, apart = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            largest = std::max(largest, std::abs(a[i]));
            apart = std::max(apart, std::isfinite(a[i] - b[i]) ? std::abs(a[i] - b[i]) : HUGE_VAL);
        }
        worst = std::max(worst, apart / largest);
    }
    return worst;
}

void print_times(const Comparison& comparison, int rounds) {
    for (std::size_t c = 1; c < comparison.list.size(); ++c) {
        const double apart = difference(comparison.list[0], comparison.list[c]);
        if (!(apart < agreement))
            throw std::runtime_error(comparison.function + " of " + comparison.list[c].name + " is " +
                                     std::to_string(apart) + " of the largest value from ours");
    }
    std::vector<double> least(comparison.list.size(), HUGE_VAL);
    for (int round = 0; round < rounds; ++round)
        for (std::size_t c = 0; c < comparison.list.size(); ++c) {
            const auto& call = comparison.list[c].call;
            for (int k = 0; k < states; ++k) call(k);  // fills the caches; not timed
            const double begin = seconds();
            double end = begin;
            int calls = 0;
            for (; end - begin < slice; end = seconds(), calls += states)
                for (int k = 0; k < states; ++k) call(k);
            least[c] = std::min(least[c], (end - begin) / calls);
        }
    std::printf("\"%s\": {", comparison.function.c_str());
    for (std::size_t c = 0; c < least.size(); ++c)
        std::printf("%s\"%s\": %.6g", c == 0 ? "" : ", ", comparison.list[c].name.c_str(), 1e9 * least[c]);
    std::printf("}");
}

int time_all(int count, char** words) {
    Contest contest(words[0], std::string(words[1]) == "floating", words[3]);
    std::vector<Comparison> comparisons = contest.comparisons();
    for (int k = 4; k + 2 < count; k += 3)
        for (Comparison& comparison : comparisons)
            if (comparison.function == words[k])
                comparison.list.push_back(contest.generated(words[k], words[k + 1], words[k + 2]));
    std::printf("{\"coordinates\": %d, \"operations\": {\"forward_jacobian\": %d", contest.size(),
                contest.ours().derivatives->operations);
    for (const char* name : {"inverse", "mass", "inverse_jacobian"})
        std::printf(", \"%s\": %d", name, contest.ours().named(name).operations);
    std::printf("}, \"ns\": {");
    for (const Comparison& comparison : comparisons) {
        if (&comparison != &comparisons.front()) std::printf(", ");
        print_times(comparison, std::atoi(words[2]));
    }
    std::printf("}}\n");
    return 0;
}

}  // namespace

int main(int count, char** words) try {
    if (count >= 5) return time_all(count - 1, words + 1);
    std::cerr << "usage: pinocchio_peer ROBOT fixed|floating ROUNDS OURS.so [FUNCTION NAME THEIRS.so]…\n";
    return 3;
} catch (const std::exception& error) {
    std::cerr << "pinocchio_peer: " << error.what() << '\n';
    return 1;
}

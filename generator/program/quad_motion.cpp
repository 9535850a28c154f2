// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/quad_motion.hpp"

#include <algorithm>
#include <cmath>

namespace alembert {

namespace {

using QuadVector = std::vector<Quad>;

Quad size_of(Quad y) {
    return std::max(Quad(1), abs(y));
}

/// One step of extrapolated midpoint rules.
class Extrapolation {
public:
    Extrapolation(const QuadRhs& rhs, std::size_t size, int columns)
        : rhs_(rhs),
          table_(static_cast<std::size_t>(columns), QuadVector(size)),
          before_(size),
          middle_(size),
          rate_(size) {}

    /// Computes the state at t + h and returns the error estimate.
    double operator()(Quad t, const QuadVector& y, const QuadVector& first_rate, Quad h, QuadVector& out) {
        const std::size_t columns = table_.size();
        double error = HUGE_VAL;
        for (std::size_t j = 0; j < columns; ++j) {
            QuadVector row = midpoint(t, y, first_rate, h, 2 * static_cast<int>(j) + 2);
            for (std::size_t k = 1; k <= j; ++k) {  // Aitken & Neville in h², along the row
                const Quad ratio = Quad(j + 1) / Quad(j + 1 - k);
                const Quad weight = 1 / (ratio * ratio - 1);
                for (std::size_t i = 0; i < y.size(); ++i) {
                    const Quad better = row[i] + (row[i] - table_[k - 1][i]) * weight;
                    table_[k - 1][i] = row[i];
                    row[i] = better;
                }
            }
            if (j + 1 == columns) error = agreement(table_[j - 1], row);
            table_[j] = std::move(row);
        }
        out = table_.back();
        return error;
    }

    long evaluations = 0;

private:
    QuadVector midpoint(Quad t, const QuadVector& y, const QuadVector& first_rate, Quad h, int steps) {
        const Quad part = h / steps;
        before_ = y;
        for (std::size_t i = 0; i < y.size(); ++i) middle_[i] = y[i] + part * first_rate[i];
        for (int k = 1; k < steps; ++k) {
            rhs_(t + k * part, middle_.data(), rate_.data());
            ++evaluations;
            for (std::size_t i = 0; i < y.size(); ++i) before_[i] += 2 * part * rate_[i];
            std::swap(before_, middle_);
        }
        return middle_;
    }

    const QuadRhs& rhs_;
    std::vector<QuadVector> table_;
    QuadVector before_, middle_, rate_;
};

/// Nodes on (0, 1) and weights ∫ of the Lagrange polynomials from 0 to each node and to 1, by Legendre's
/// polynomials, with which interpolation on Gauss's nodes loses no digits: l_j(x) = w_j Σ (2k+1) P_k(x_j) P_k(x).
struct Gauss {
    static constexpr int stages = 14;
    Quad c[stages], b[stages], a[stages][stages];

    Gauss() {
        Quad P[stages + 2];
        const auto legendre = [&P](Quad x) {  // on (−1, 1)
            P[0] = 1;
            P[1] = x;
            for (int k = 1; k <= stages; ++k) P[k + 1] = ((2 * k + 1) * x * P[k] - k * P[k - 1]) / (k + 1);
        };
        for (int i = 0; i < stages; ++i) {
            Quad x = -cos((Quad(i) + Quad(3) / 4) / (Quad(stages) + Quad(1) / 2) * acos(Quad(-1)));
            Quad slope = 1;
            for (int round = 0; round < 8; ++round) {
                legendre(x);
                slope = stages * (x * P[stages] - P[stages - 1]) / (x * x - 1);
                x -= P[stages] / slope;
            }
            legendre(x);
            c[i] = (1 + x) / 2;
            b[i] = 1 / ((1 - x * x) * slope * slope);
        }
        Quad at_node[stages][stages + 2];
        for (int i = 0; i < stages; ++i) {
            legendre(2 * c[i] - 1);
            std::copy_n(P, stages + 2, at_node[i]);
        }
        for (int i = 0; i < stages; ++i)
            for (int j = 0; j < stages; ++j) {
                Quad sum = c[i];  // ∫₀^c of P_k is (P_{k+1} − P_{k−1})/(2(2k+1))
                for (int k = 1; k < stages; ++k)
                    sum += at_node[j][k] * (at_node[i][k + 1] - at_node[i][k - 1]) / 2;
                a[i][j] = b[j] * sum;
            }
    }
};

class Collocation {
public:
    Collocation(const QuadRhs& rhs, const RoughRhs& rough, std::size_t size, const QuadOptions& options)
        : rhs_(rhs),
          rough_(rough),
          options_(options),
          slopes_(Gauss::stages, QuadVector(size)),
          defect_(slopes_),
          here_(size),
          trial_(size),
          change_(size),
          rough_slopes_(Gauss::stages, Rough(size)),
          correction_(rough_slopes_),
          rough_defect_(rough_slopes_),
          places_(rough_slopes_),
          rates_(rough_slopes_),
          rough_trial_(size),
          rough_rate_(size) {
        for (int i = 0; i < Gauss::stages; ++i)
            for (int j = 0; j < Gauss::stages; ++j) a_[i][j] = static_cast<double>(gauss_.a[i][j]);
    }

    bool step(Quad t, QuadVector& y, Quad h, int depth = 0) {
        if (evaluations > options_.budget || depth > 20) return false;
        if (iterate(t, y, h)) {
            for (std::size_t i = 0; i < y.size(); ++i) {
                Quad sum = 0;
                for (std::size_t j = 0; j < Gauss::stages; ++j) sum += gauss_.b[j] * slopes_[j][i];
                y[i] += h * sum;
            }
            return true;
        }
        return step(t, y, h / 2, depth + 1) && step(t + h / 2, y, h / 2, depth + 1);
    }

    long evaluations = 0;

private:
    using Rough = std::vector<double>;
    static constexpr int most_rounds = 60;

    /// Iterates until the corrections no longer shrink, that is, to rounding.
    bool iterate(Quad t, const QuadVector& y, Quad h) {
        rhs_(t, y.data(), change_.data());
        ++evaluations;
        for (std::size_t n = 0; n < y.size(); ++n) {
            here_[n] = static_cast<double>(y[n]);
            for (Rough& slope : rough_slopes_) slope[n] = static_cast<double>(change_[n]);
        }
        if (!begin(static_cast<double>(t), static_cast<double>(h))) return false;
        for (std::size_t i = 0; i < Gauss::stages; ++i)
            std::copy(rough_slopes_[i].begin(), rough_slopes_[i].end(), slopes_[i].begin());
        double former = HUGE_VAL;
        for (int round = 0; round < most_rounds; ++round) {
            const double change = defects(t, y, h);
            if (!(change < HUGE_VAL)) return false;
            const bool stalls = round > 0 && !(change < former / 4);
            if (change <= options_.tolerance || stalls) {
                for (std::size_t i = 0; i < Gauss::stages; ++i)
                    for (std::size_t n = 0; n < y.size(); ++n) slopes_[i][n] += defect_[i][n];
                return change <= options_.tolerance || (change < 1e4 * options_.tolerance && change < former);
            }
            correct(static_cast<double>(t), static_cast<double>(h), change);
            former = change;
        }
        return false;
    }

    /// Solves k_i = f(y + h Σ a_ij k_j) in doubles, to rounding; each k_i uses the newest values of the others
    /// (Gauss-Seidel).
    bool begin(double t, double h) {
        double former = HUGE_VAL;
        for (int round = 0; round < most_rounds; ++round) {
            double change = 0;
            for (std::size_t i = 0; i < Gauss::stages; ++i) {
                for (std::size_t n = 0; n < here_.size(); ++n)
                    rough_trial_[n] = here_[n] + h * weighted(i, rough_slopes_, n);
                rough_(t + static_cast<double>(gauss_.c[i]) * h, rough_trial_.data(), rough_rate_.data());
                for (std::size_t n = 0; n < here_.size(); ++n) {
                    const double difference =
                        h * std::abs(rough_rate_[n] - rough_slopes_[i][n]) / std::max(1.0, std::abs(here_[n]));
                    if (!std::isfinite(difference)) return false;
                    change = std::max(change, difference);
                }
                std::swap(rough_slopes_[i], rough_rate_);
            }
            if (change < 1e-15) return true;
            if (round > 1 && !(change < former / 4)) return change < 1e-10;
            former = change;
        }
        return false;
    }

    /// Computes the residuals f(y + h Σ a_ij k_j) − k_i and returns the largest of them times h.
    double defects(Quad t, const QuadVector& y, Quad h) {
        double largest = 0;
        for (std::size_t i = 0; i < Gauss::stages; ++i) {
            for (std::size_t n = 0; n < y.size(); ++n) {
                Quad sum = 0;
                for (std::size_t j = 0; j < Gauss::stages; ++j) sum += gauss_.a[i][j] * slopes_[j][n];
                trial_[n] = y[n] + h * sum;
                places_[i][n] = static_cast<double>(trial_[n]);
            }
            rhs_(t + gauss_.c[i] * h, trial_.data(), change_.data());
            ++evaluations;
            for (std::size_t n = 0; n < y.size(); ++n) {
                if (!is_finite(change_[n])) return HUGE_VAL;
                defect_[i][n] = change_[n] - slopes_[i][n];
                largest = std::max(largest, static_cast<double>(h * abs(defect_[i][n]) / size_of(y[n])));
            }
        }
        return largest;
    }

    /// δ_i = d_i + J h Σ a_ij δ_j in doubles, with J along the change from a difference of f. This gives seven
    /// digits of δ, whatever its size.
    void correct(double t, double h, double unit) {
        constexpr double apart = 1e-8;
        for (std::size_t i = 0; i < Gauss::stages; ++i) {
            rough_(t + static_cast<double>(gauss_.c[i]) * h, places_[i].data(), rates_[i].data());
            for (std::size_t n = 0; n < here_.size(); ++n)
                correction_[i][n] = rough_defect_[i][n] = static_cast<double>(defect_[i][n] / unit);
        }
        double former = HUGE_VAL;
        for (int round = 0; round < most_rounds; ++round) {
            double change = 0;
            for (std::size_t i = 0; i < Gauss::stages; ++i) {
                for (std::size_t n = 0; n < here_.size(); ++n)
                    rough_trial_[n] = places_[i][n] + apart * h * weighted(i, correction_, n);
                rough_(t + static_cast<double>(gauss_.c[i]) * h, rough_trial_.data(), rough_rate_.data());
                for (std::size_t n = 0; n < here_.size(); ++n) {
                    const double next = rough_defect_[i][n] + (rough_rate_[n] - rates_[i][n]) / apart;
                    change = std::max(change,
                                      h * std::abs(next - correction_[i][n]) / std::max(1.0, std::abs(here_[n])));
                    correction_[i][n] = next;
                }
            }
            if (!(change > 1e-9) || !(change < former)) break;
            former = change;
        }
        for (std::size_t i = 0; i < Gauss::stages; ++i)
            for (std::size_t n = 0; n < here_.size(); ++n)
                slopes_[i][n] += static_cast<Quad>(unit) * static_cast<Quad>(correction_[i][n]);
    }

    double weighted(std::size_t i, const std::vector<Rough>& values, std::size_t n) const {
        double sum = 0;
        for (std::size_t j = 0; j < Gauss::stages; ++j) sum += a_[i][j] * values[j][n];
        return sum;
    }

    const QuadRhs& rhs_;
    const RoughRhs& rough_;
    const QuadOptions& options_;
    const Gauss gauss_;
    double a_[Gauss::stages][Gauss::stages];
    std::vector<QuadVector> slopes_, defect_;
    Rough here_;
    QuadVector trial_, change_;
    std::vector<Rough> rough_slopes_, correction_, rough_defect_, places_, rates_;
    Rough rough_trial_, rough_rate_;
};

}  // namespace

double agreement(const QuadVector& a, const QuadVector& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Quad difference = abs(a[i] - b[i]) / size_of(b[i]);
        if (!is_finite(difference)) return HUGE_VAL;
        largest = std::max(largest, static_cast<double>(difference));
    }
    return largest;
}

namespace {

/// Where a step from t ends at the latest.
Quad latest_end(const std::vector<double>& mesh, Quad t, Quad end) {
    const auto next = std::upper_bound(mesh.begin(), mesh.end(), static_cast<double>(t));
    return mesh.end() - next < 2 ? end : std::min(end, Quad(*(next + 1)));
}

}  // namespace

QuadMotion extrapolate(const QuadRhs& rhs, QuadVector state, Quad start, Quad end, const QuadOptions& options) {
    const int columns = std::clamp(static_cast<int>(std::lround(-std::log10(options.tolerance) / 2)), 4, 14);
    Extrapolation one(rhs, state.size(), columns);
    QuadVector rate(state.size()), next(state.size());
    QuadMotion motion{.finished = false, .state = {}, .mesh = {start}};
    Quad t = start, h = (end - start) / 100;
    while (t < end) {
        if (one.evaluations > options.budget || t + h / 1024 == t) break;
        rhs(t, state.data(), rate.data());
        ++one.evaluations;
        for (double error = HUGE_VAL; error > options.tolerance && one.evaluations <= options.budget;) {
            const Quad latest = latest_end(options.mesh, t, end),
                       to = t + Quad(1.01) * h < latest ? t + h : latest;
            error = one(t, state, rate, to - t, next);
            const double factor =
                0.9 * std::pow(options.tolerance / std::max(error, 1e-300), 1.0 / (2 * columns - 1));
            h = (to - t) * Quad(std::isfinite(error) ? std::clamp(factor, 0.1, 3.0) : 0.1);
            if (error <= options.tolerance) {
                t = to;
                state.swap(next);
                motion.mesh.push_back(t);
            } else if (t + h / 1024 == t) {
                break;
            }
        }
    }
    motion.finished = !(t < end);
    motion.state = std::move(state);
    motion.evaluations = one.evaluations;
    return motion;
}

QuadMotion collocate(const QuadRhs& rhs, const RoughRhs& rough, QuadVector state, const std::vector<Quad>& mesh,
                     const QuadOptions& options) {
    Collocation one(rhs, rough, state.size(), options);
    QuadMotion motion{.finished = true, .state = {}, .mesh = mesh};
    for (std::size_t k = 0; k + 1 < mesh.size() && motion.finished; ++k)
        motion.finished = one.step(mesh[k], state, mesh[k + 1] - mesh[k]);
    motion.state = std::move(state);
    motion.evaluations = one.evaluations;
    return motion;
}

}  // namespace alembert

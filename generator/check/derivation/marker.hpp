// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Goes through a derivation line by line.
///
///     Marker marker(system, written, letters);
///     marker.run();
///     marker.lines[0].status

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "check/derivation/bindings.hpp"
#include "check/derivation/claim_text.hpp"
#include "check/derivation/first_order.hpp"
#include "check/derivation/heard.hpp"
#include "check/derivation/marked.hpp"
#include "check/derivation/own_world.hpp"
#include "check/derivation/rest_states.hpp"
#include "check/derivation/special_values.hpp"

namespace alembert {

/// A number, perhaps with a unit, π or a fraction of such.
bool is_number(const Math& side);

/// 3, 3 kg; also 1 m, which may be a mass.
bool may_be_number_with_unit(const Math& side, const Letters& letters);

/// A number with a point stands in it.
bool holds_decimals(const Math& math);

/// 2 π as a factor of it, as of a period.
bool holds_whole_turn(const Math& math);

/// A number that has been rounded, or one with a unit: 4.47 rad/s.
bool is_rounded_value(const Math& side);

/// What was found about a line while it was judged.
struct LineNotes {
    LineClaim claim = {};  ///< empty where there is none
    ClaimText left = {}, right = {};
    bool is_sure = false;                    ///< whether a mistake has been judged for what the words say
    bool has_assumed = false;                ///< whether words or lines above speak of special states or cases
    bool is_of_rest = false;                 ///< whether the words are about rest
    bool alone_is_quantity = false;          ///< as in ClaimWriting
    bool rates_are_speeds = false;           ///< likewise
    bool slopes_are_of_motion = false;       ///< likewise
    bool differentials_are_rates = false;    ///< likewise
    std::optional<GiNaC::ex> expanded = {};  ///< of an approximation, the left side to the order that is written
    std::optional<BaseState> near = {};      ///< about which the derivation linearizes there
    std::optional<MotionRow> equation = {};  ///< set if it is a right equation of motion, written out
    /// Names with the values that the derivation has stated, if some that stand in the line are wrong.
    std::map<std::string, GiNaC::ex> own = {};
};

class Marker {
public:
    Marker(DerivedSystem& system, const Written& written, Letters letters);
    Marker(const Marker&) = delete;
    Marker& operator=(const Marker&) = delete;

    /// The marks, without the verdicts of the check.
    void run();
    /// Asks the check about each line: proved or refuted, and the slip of a mistake.
    void verify();
    /// The coordinates whose equation of motion no right line gives.
    std::vector<std::string> missing();

    std::vector<MarkedLine> lines;
    const Letters& letters() const { return letters_; }
    /// What was assumed about letters for values of coordinates, in words.
    std::vector<std::string> remarks() const;
    /// How much of it makes sense: the measure by which letters are chosen.
    double score() const;

private:
    /// A line while it is judged.
    struct Sides {
        const Math *lhs = nullptr, *rhs = nullptr;
        ClaimText left, right;          ///< as the system has it
        ClaimText own_left, own_right;  ///< with the derivation's own steps
        std::set<std::string> own_names() const;
    };
    using Components = std::vector<MathPtr>;

    void find_effective_potentials();
    bool assumes() const;
    void line(std::size_t statement, std::size_t side);
    void judge(MarkedLine& line, const Math& lhs, const Math& rhs, Relation relation);
    bool is_of_motion(const Math& side) const;
    bool is_of_place(const Math& side) const;
    bool is_of_limit(MarkedLine& line, const Math& lhs) const;
    bool is_unknown_force(const Letter& letter) const;
    bool is_effective_potential(const Math& lhs, const Math& rhs) const;
    bool holds_letters_that_move(const Math& math) const;
    std::optional<double> in_numbers(const GiNaC::ex& value, const GiNaC::exmap& values) const;
    std::optional<double> value_of_numbers(const Math& side);
    GiNaC::exmap own_values() const;
    std::optional<GiNaC::ex> datum_of(const GiNaC::ex& parameter, const Math& stated);
    bool judge_calculation(MarkedLine& line, const Math& formula, double written);
    bool judge_value(MarkedLine& line, const Math& lhs, const Math& rhs, Relation relation);
    void judge_pair(MarkedLine& line, const Math& lhs, const Math& rhs);
    bool judge_virtual(MarkedLine& line, const Math& lhs, const Math& rhs);
    void judge_work(MarkedLine& line, const Math& lhs, const Math& rhs);
    std::vector<std::vector<GiNaC::ex>> forces_of_loads() const;
    bool is_sum_of(const std::vector<std::vector<GiNaC::ex>>& parts, const std::vector<GiNaC::ex>& forces);
    bool is_work_of_part(const std::vector<GiNaC::ex>& stated);
    void judge_displacements(MarkedLine& line, const Math& lhs, const Math& rhs);
    bool bind_to_force(MarkedLine& line, const Math& lhs, const Math& rhs, const Letter& letter);
    void take_in_displacement(const Math& lhs, const Math& rhs);
    bool find_place(MarkedLine& line, const Math& lhs, const Math& rhs, const Letter& letter);
    void judge_admissible(MarkedLine& line, const Math& lhs, const Math& rhs);
    Sides sides_of(const Math& lhs, const Math& rhs) const;
    ClaimWriting as_written() const;
    ClaimWriting as_derived() const;
    bool is_of_quantity(MarkedLine& line, const Sides& sides);
    bool is_in_independent_rates(MarkedLine& line, const Sides& sides);
    std::vector<BaseState> bases() const;
    void note_base(const Math& lhs, const Math& rhs, const Letter& deviation);
    bool is_along_motion(MarkedLine& line, const Sides& sides);
    bool is_lone_force(const Math& side) const;
    void note_forces(const Sides& sides);
    bool is_from_own_hamiltonian(MarkedLine& line, const Sides& sides);
    bool follows_with_all_forces(MarkedLine& line, const Sides& sides);
    GiNaC::ex own_residual(const Sides& sides);

    bool is_balance(const Sides& sides) const;
    bool stands_by_itself(const Sides& sides, bool is_identity) const;
    void judge_true(MarkedLine& line, const Sides& sides, const MotionRow& row);
    void judge_false(MarkedLine& line, const Sides& sides, const MotionRow& row);
    bool holds_with_all_forces(MarkedLine& line, const Sides& sides);
    bool holds_up_to(MarkedLine& line, const Sides& sides, const GiNaC::ex& residual);
    bool is_given_value(MarkedLine& line, const Sides& sides);
    bool is_aside() const;
    bool is_assumption(MarkedLine& line, const Sides& sides);
    bool is_reduced_momentum(MarkedLine& line, const Sides& sides);
    bool deviates_from_motion() const;
    bool holds_near_some_rest(MarkedLine& line, const GiNaC::ex& residual);
    const Letter* letter_of_frequency(const Math& lhs, const Math& rhs, std::map<Letter, int>& all) const;
    bool is_frequency_equation(MarkedLine& line, const Math& lhs, const Math& rhs);
    bool is_approximation(MarkedLine& line, const Sides& sides);
    bool holds_near(MarkedLine& line, const Sides& sides, const GiNaC::ex& residual);
    bool states_second_order(const Sides& sides, const GiNaC::ex& residual, const BaseState& base);
    bool is_angle_of_rest(MarkedLine& line, const Math& side, const ClaimText& value);
    bool is_condition_on_potential(MarkedLine& line, const Math& lhs, const Math& rhs);
    RestStates& states_of_rest(bool steady, const GiNaC::exmap& special);
    RestStates::Found found_at_rest(const std::function<RestStates::Found(RestStates&)>& ask, bool may_be_steady,
                                    std::string& reason);
    bool is_at_rest(MarkedLine& line, const GiNaC::ex& residual, const RestStates::About& about,
                    bool may_be_steady);
    bool holds_at_some_rest(MarkedLine& line, const Sides& sides);
    bool names_coordinate(const Math& side) const;
    bool is_steady_value(const Math& side, const Math& letter);
    GiNaC::symbol coordinate_of_value(const Letter& letter) const;
    void know_state_letter(const Letter& letter, const GiNaC::symbol& value);
    bool names_state(const std::map<Letter, int>& all) const;
    bool says_state(const std::map<Letter, int>& all) const;
    bool is_of_state_letter(MarkedLine& line, const Math& lhs, const Math& rhs);
    MathPtr with_slopes(const MathPtr& math) const;
    bool is_at_number(MarkedLine& line, const Math& lhs, const Math& rhs);
    bool holds_with_slopes(MarkedLine& line, const Math& lhs, const Math& rhs);
    bool is_condition_of_parameters(const Sides& sides);
    bool is_of_rest_unsaid(MarkedLine& line, const Sides& sides);
    bool holds_to_digits(const Sides& sides);
    bool vanishes_at(const GiNaC::ex& residual, const GiNaC::exmap& place) const;
    bool holds_from_start(const GiNaC::ex& residual);
    bool holds_at_stated_place(const Sides& sides);
    bool holds_where_held(const GiNaC::ex& residual);
    void note_place(const Math& lhs, const Math& rhs);
    void note_rates();
    bool holds_function_of_state(const Math& math) const;
    bool is_refuted_at_state(MarkedLine& line, const GiNaC::ex& residual, const RestStates::About& there,
                             bool is_of_motion);
    bool has_steady_rates_alone(const GiNaC::ex& residual, const Math& lhs, const Math& rhs);
    bool is_near_state(MarkedLine& line, const GiNaC::ex& residual, const RestStates::About& about);
    bool is_equilibrium(MarkedLine& line, const Sides& sides);
    void define_frequency(MarkedLine& line, const Math& letter, const Math& rhs, int power);
    bool is_of_parameters(const GiNaC::ex& value) const;
    std::vector<GiNaC::symbol> symbols_of_places() const;
    bool is_frequency_at_rest(MarkedLine& line, const Math& letter, const Math& rhs, int power,
                              const std::string& square);
    bool is_frequency_again(MarkedLine& line, const Math& letter, const Math& rhs, int power);
    bool is_frequency(MarkedLine& line, const Math& letter, const Math& rhs, int power);
    bool holds_at_rest(MarkedLine& line, const Sides& sides);
    bool is_condition_of_rest(MarkedLine& line, const Sides& sides);
    bool is_root(MarkedLine& line, const Sides& sides);
    void follows_as_constant(MarkedLine& line, const ClaimText& text);
    bool is_meant_as_inertia(const Letter& letter) const;
    bool is_foreign_inertia(const Letter& letter, const GiNaC::ex& value);
    bool is_an_inertia(const GiNaC::ex& value);
    struct WrongInertia {
        GiNaC::ex energy;
        std::string meant;
    };
    std::vector<WrongInertia> energies_with_inertia(const GiNaC::ex& value);
    bool follows_from_inertia(MarkedLine& line, const Sides& sides);
    void blame_inertia(MarkedLine& line, std::size_t definition, const std::string& meant);
    bool is_from_inertia(MarkedLine& line, const std::function<std::optional<std::size_t>()>& from);
    bool is_same_at_rest(const GiNaC::ex& residual, const GiNaC::ex& other) const;
    bool follows(MarkedLine& line, const Sides& sides);
    bool is_potential_of_all(MarkedLine& line, const Sides& sides);
    void know_potential(const GiNaC::ex& value);
    void note_reduced(const Sides& sides, const MotionRow& row);
    bool is_constant_of_potential(MarkedLine& line, const Sides& sides, const Letter& letter,
                                  const GiNaC::ex& value);
    bool is_energy_of_part(MarkedLine& line, const Sides& sides);
    bool is_of_own_gauge(MarkedLine& line, const Sides& sides);

    bool introduce(MarkedLine& line, const Math& lhs, const Math& rhs, bool turned = false);
    bool is_constant_of_motion(MarkedLine& line, const Math& letter, const ClaimText& text, bool turned);
    bool bind_to_scene(MarkedLine& line, const Math& letter, const Math& rhs, int power);
    void define(MarkedLine& line, const Math& letter, const Math& rhs, int power);
    void hold_against_momenta(MarkedLine& line, const Math& letter, const Math& value);
    void hold_momenta(const std::string& name, const ClaimText& text, const ClaimText& own,
                      std::optional<std::size_t> wrong);
    std::vector<Binding> bindings(const Letter& letter) const;
    bool counts_other_things(const Letter& letter) const;
    void bind_sines_by_index();
    void find_moving_letters();
    void count_letters();
    void hear_bodies(const std::string& words);
    void hear_special_values(const std::string& words);
    bool is_value_of_state(const Letter& letter) const;
    bool depends_on_state(const Letter& letter) const;
    bool states_special_case(const Math& lhs, const Math& rhs, const std::map<Letter, int>& all) const;
    bool is_of_state(MarkedLine& line, const Math& lhs, const Math& rhs);
    void weigh_condition(MarkedLine& line, const Math& lhs, const Math& rhs);
    bool states_relation_of_constants(const Math& lhs, const Math& rhs);
    const Letter* place_of_rate(const Math& math) const;
    std::optional<std::string> excuse(const MarkedLine& line, const Math& lhs, const Math& rhs);
    bool keeps_to_time(const Math& lhs, const Math& rhs);
    bool is_of_one_motion(const Math& lhs, const Math& rhs);
    bool is_written_rate(const Math& side) const;
    bool is_wrong_derivative(MarkedLine& line, const Sides& sides);
    std::vector<CheckedClaim> checked_alone(const LineClaim& claim) const;
    bool is_on_branch(MarkedLine& line, const Sides& sides);
    bool is_said_to_be_conserved(MarkedLine& line, const ClaimText& text, const Letter& letter, bool turned);
    void take_in_special_case(const Math& lhs, const Math& rhs);
    void take_in_relation(const Math& lhs, const Math& rhs);
    void stop_input(const GiNaC::ex& name, const GiNaC::ex& value);
    void set_special_value(const GiNaC::ex& name, const GiNaC::ex& value);
    bool follows_in_special_case(const GiNaC::ex& residual);
    bool follows_with(const GiNaC::ex& residual, const GiNaC::exmap& values);
    void settle_in_special_case(MarkedLine& line);
    std::string told_values(const GiNaC::exmap& values) const;
    GiNaC::ex kept_of(const Math& lhs, const Math& rhs);
    bool does_not_change(const GiNaC::ex& expression);
    bool keeps_its_start(const Math& lhs, const Math& rhs);
    bool is_of_derivative_at_place(const Math& side) const;
    bool is_wrong_energy_of_start(const GiNaC::ex& residual, const Math& lhs, const Math& rhs);
    void note_start(const GiNaC::ex& kept);
    bool follows_from_start(const Math& lhs, const Math& rhs);
    bool keeps_its_start_at(const GiNaC::ex& residual, const Math& lhs, const Math& rhs);
    bool changes_in_motion(const std::string& name) const;
    bool introduce_ahead(const Letter& letter);
    bool bind_to_part(const Letter& letter, const Math* value = nullptr);
    static bool component_of_axis(const Letter& letter);
    bool is_on_other_axis(const Letter& letter, const GiNaC::ex& value);
    void count_velocity(const Letter& letter, int dots, const std::string& text);
    bool bind_to_momentum(MarkedLine& line, const Math& lhs, const Math& rhs, const Letter& letter);
    bool is_multiplier(const std::string& name) const;
    bool is_input(const std::string& name) const;
    bool holds_rates(const Math& math) const;
    bool says_rest() const;
    bool assumes_rest() const;
    bool is_parameter_identity(const Math& lhs, const Math& rhs);
    bool holds_at_pose(const Sides& sides);
    const std::vector<GiNaC::symbol>& still_after_impact();
    bool is_kept(const Sides& sides);
    bool holds_after_impact(MarkedLine& line, const Sides& sides);
    bool is_of_authors_function(MarkedLine& line, const Math& lhs, const Math& rhs);
    bool speaks_of_acceleration() const;
    std::optional<GiNaC::ex> force_along_speed(const Letter& letter) const;
    bool is_value_of(const Math& value, const GiNaC::ex& truth);
    GiNaC::ex numbered_otherwise(const Letter& letter, const Math& value, const GiNaC::ex& part);
    std::optional<GiNaC::ex> other_force(const Letter& letter, const Math& value,
                                         const std::optional<GiNaC::ex>& force);
    void know_speed(const std::string& key, const std::vector<GiNaC::ex>& slopes);
    bool find_meaning(MarkedLine& line, const Math& lhs, const Math& rhs, const Letter& letter);
    bool determine(MarkedLine& line, const Math& lhs, const Math& rhs, const Letter& letter);
    bool determine_by_rate(MarkedLine& line, const Math& lhs, const Math& rhs, const Letter& letter);
    std::string bind(const Letter& letter, const GiNaC::ex& truth);

    bool judge_vector(MarkedLine& line, const Math& lhs, const Math& rhs);
    std::optional<Components> components(const Math& math) const;
    std::optional<Components> matrix_times_vector(const Math& product) const;
    bool is_column(MarkedLine& line, const Math& lhs, const Math& rhs) const;
    bool lists_coordinates(const Math& lhs, const Math& rhs);
    bool bind_vector(const Math& letter, const Components& value);

    void take_in(std::size_t statement, std::size_t side);
    bool repeats_law(const Math& value) const;
    void take_in_as(const Math& what, const Math& value);
    void use_all_forces(bool all);
    void leave_undefined(MarkedLine& line);
    bool is_judged_wrong(std::size_t k) const;
    bool has_several_unknown(const Math& lhs, const Math& rhs) const;
    bool has_quantities(const Sides& sides) const;
    bool repeats_law(const Sides& sides) const;
    bool is_law_of_hamilton(const Sides& sides) const;
    bool speaks_of_quantity(const LineNotes& notes) const;
    std::map<std::string, GiNaC::ex> known_in_motion() const;
    std::map<std::string, GiNaC::ex> known_to_check() const;
    std::optional<LineClaim> from_start_of_chain(const MarkedLine& line) const;
    void find_slip_of_approximation(MarkedLine& line, const LineNotes& notes);
    void blame_definition(std::size_t k, const std::map<std::string, GiNaC::ex>& known);
    void find_slip(MarkedLine& line, LineNotes& notes, const std::map<std::string, GiNaC::ex>& known);
    void seek_in_integral(MarkedLine& line, LineNotes& notes, const std::map<std::string, GiNaC::ex>& known);
    bool is_plausible(const std::optional<Slip>& slip, const LineClaim& claim);
    std::optional<int> order_of(const std::string& expression);
    int order_of(const LineClaim& claim);
    bool has_quantity(const LineNotes& notes) const;
    bool has_free_constant(const LineNotes& notes) const;
    bool has_one_reading(std::size_t k) const;
    bool holds_parameter(const LineClaim& claim);
    void withhold_unexplained(std::size_t k);
    void name_held(MarkedLine& line) const;
    void locate_term(MarkedLine& line, const LineNotes& notes) const;
    void adopt(MarkedLine& line, LineNotes& notes, CheckedClaim verdict);

    DerivedSystem& system_;
    const Written& written_;
    Letters letters_;
    World truth_;
    OwnWorld own_;
    std::map<std::string, GiNaC::ex> known_;  ///< names beside those of the scene, as they are in the system
    std::map<Letter, Components> vectors_;    ///< letters that are vectors, with the letters of their components
    std::vector<LineNotes> notes_;            ///< one for each line
    std::map<std::string, std::vector<std::pair<std::string, std::string>>> speeds_;  ///< as in ClaimWriting
    std::set<Letter> ahead_;  ///< letters that a later line introduces, and that were used before it
    struct Motion {
        std::string point;
        bool is_velocity;
    };
    std::map<Letter, Motion> motions_;           ///< letters that are places and velocities
    std::set<Letter> frequency_letters_;         ///< ω that the derivation has found
    std::map<std::size_t, GiNaC::ex> inertias_;  ///< lines that define a moment of inertia that the scene has not
    std::map<std::string, std::size_t> counts_;  ///< the largest number of x_1, x_2 …, by letter
    std::set<Letter> of_rate_;                   ///< those of which only the rate has been said: φ of φ' = x'/r
    std::set<Letter> roaming_;  ///< letters that were found for a body, as v_x is that of each body in turn
    std::string spoken_;        ///< the body of which the words speak
    const WrittenStatement* statement_ = nullptr;
    Heard heard_;
    std::string said_before_;              ///< the words around the statement before this one
    std::vector<BaseState> own_bases_;     ///< θ = π + ε: about which the author deviates
    std::optional<BaseState> near_;        ///< about which the derivation linearizes, once a line has shown it
    bool solves_constraints_ = false;      ///< whether its ∂/∂ψ' have been those of the independent rates
    std::set<Letter> seen_;                ///< letters of this line and those before
    Relation relation_ = Relation::equal;  ///< of the line
    bool is_new_law_ = false;              ///< whether the line states a letter that stands nowhere before
    bool has_own_gauge_ = false;           ///< whether its L differs from the scene's by a total derivative
    bool is_of_special_start_ = false;     ///< whether a line has held for motions with a special start alone
    std::set<Letter> motion_letters_;      ///< in formulas of one motion: A and B of A cos ω t
    std::vector<std::unique_ptr<RestStates>> states_;  ///< of rest and of steady motion, in all cases and special
    std::set<Letter> state_letters_;                   ///< θ_0 of a coordinate θ
    std::vector<std::string> remarks_;                 ///< what else was assumed about letters
    std::set<Letter> moving_letters_;                  ///< z_f of z_f = z + a θ, which is no value at one state
    GiNaC::exmap places_;                              ///< their symbols, with the coordinates
    std::vector<GiNaC::ex> rest_relations_;            ///< what lines have shown to vanish at these states
    bool is_of_case_ = false;        ///< whether what was found last at rest is of special values
    std::set<Letter> rest_letters_;  ///< those of which a line has shown that they are values at rest
    bool is_state_wrong_ = false;    ///< whether one of these lines was wrong
    bool has_assumed_ = false;       ///< as in LineNotes
    bool is_judging_ = false;        ///< whether a line is being judged, and not its words heard
    bool is_taken_there_ = false;    ///< U''(r) for U''(r_0): its coordinates are those of the state
    std::set<std::string> rounded_;  ///< names of letters that are written with decimals, ω_1 = 0.618 ω_0
    GiNaC::exmap start_rates_;       ///< x' = ω y of motions with a special start
    GiNaC::exmap start_place_;       ///< φ = π/2 of "released from rest at φ = π/2"
    bool is_place_held_ = false;     ///< and whether the words say that the coordinate is held there
    GiNaC::exmap stated_place_;      ///< θ = 0 of "at the bottom, θ = 0, T is …", in the same sentence
    SpecialValues special_;
    GiNaC::exmap used_values_;  ///< those of them for which the last line followed
    std::optional<std::vector<GiNaC::symbol>> still_after_impact_;  ///< rates that are zero then
    std::set<std::string> kept_;  ///< names of constants of the motion that are momenta, or written as such
    const std::map<std::string, std::string>* displacements_ = nullptr;  ///< while a line with δ is judged
    std::map<std::string, std::string> held_;  ///< ∂ of the author's functions, with what they are written in held
    std::set<std::string> constants_;    ///< names of constants of the motion that the derivation calls by a word
    bool is_autonomous_ = false;         ///< whether nothing in the system changes with time by itself
    bool has_potential_of_all_ = false;  ///< whether V has been stated with the potential of loads
    bool has_told_forces_ = false;       ///< whether a line has shown which forces are in Q
    bool all_forces_ = false;            ///< whether its generalized forces contain those of the potential
};

}  // namespace alembert

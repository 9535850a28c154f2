// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/sweep_rows.hpp"

#include "simulate/byte_text.hpp"

namespace alembert {

namespace {

enum class Ended : char { as_wished, by_event, by_failure };

}  // namespace

std::string bytes_of(const std::vector<SweptMotion>& motions) {
    std::string out;
    for (const SweptMotion& m : motions) {
        for (const double value : end_values(m)) put_bytes(out, value);
        for (const double value : m.along) put_bytes(out, value);
        for (const long count : {m.steps, m.rejected, m.evaluations}) put_bytes(out, count);
        put_bytes(out, m.failed ? Ended::by_failure : m.status == "stopped" ? Ended::by_event : Ended::as_wished);
        if (m.failed) put_bytes(out, std::string_view(m.status));
    }
    return out;
}

std::vector<SweptMotion> motions_of(std::string_view bytes, const Sweep& s, SweepPart part) {
    ByteReader in(bytes);
    std::vector<SweptMotion> motions(part.count);
    const std::size_t along = along_columns(s).size();
    for (std::size_t k = 0; k < part.count; ++k) {
        SweptMotion& m = motions[k];
        m.varied = s.grid.point(part.first + k);
        m.time = in.take<double>();
        m.final_coordinates.resize(s.coordinates.size());
        m.final_rates.resize(s.coordinates.size());
        m.final_speeds.resize(s.speeds.size());
        m.final_states.resize(s.states.size());
        for (auto* const values : {&m.final_coordinates, &m.final_rates, &m.final_speeds, &m.final_states})
            for (double& value : *values) value = in.take<double>();
        m.drift = in.take<double>();
        m.along.resize(along);
        for (double& value : m.along) value = in.take<double>();
        for (long* const count : {&m.steps, &m.rejected, &m.evaluations}) *count = in.take<long>();
        const auto ended = in.take<Ended>();
        m.failed = ended == Ended::by_failure;
        m.status = m.failed ? in.text() : ended == Ended::by_event ? "stopped" : "done";
    }
    if (!in.is_at_end()) throw std::runtime_error("a record of a sweep is too long");
    return motions;
}

}  // namespace alembert

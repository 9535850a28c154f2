// SPDX-License-Identifier: MIT
// Writes C for a function of a robot's dynamics, by CppADCodeGen from Pinocchio's algorithms:
//
//   pinocchio_code ROBOT fixed|floating FUNCTION LENGTH FOLDER
//
// pinocchio.sh compiles this without optimization, in 85 s: with -O1 g++ takes more than ten minutes for all these
// algorithms on recorded numbers, and the longest function is written in a second even so.
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <pinocchio/codegen/cppadcg.hpp>

#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include "pinocchio_robot.hpp"

namespace {

using namespace alembert;

using Code = CppAD::cg::CG<double>;
using Recorded = CppAD::AD<Code>;
using RecordedVector = Eigen::Matrix<Recorded, Eigen::Dynamic, 1>;
using RecordedMatrix = Eigen::Matrix<Recorded, Eigen::Dynamic, Eigen::Dynamic>;

RecordedVector in_a_row(const std::vector<RecordedMatrix>& blocks) {
    RecordedVector result(static_cast<int>(blocks.size()) * blocks[0].size());
    int at = 0;
    for (const RecordedMatrix& block : blocks)
        for (int i = 0; i < block.rows(); ++i)
            for (int j = 0; j < block.cols(); ++j) result[at++] = block(i, j);
    return result;
}

RecordedVector values(const std::string& function, const Model& of, const RecordedVector& x) {
    const int n = of.nv;
    const ModelOf<Recorded> model = of.cast<Recorded>();
    DataOf<Recorded> data(model);
    const RecordedVector q = x.head(n), v = x.segment(n, n), last = x.tail(n);
    RecordedMatrix Dq = RecordedMatrix::Zero(n, n), Dv = Dq, Da = Dq;
    if (function == "forward") return pinocchio::aba(model, data, q, v, last);
    if (function == "inverse") return pinocchio::rnea(model, data, q, v, last);
    if (function == "mass") {
        pinocchio::crba(model, data, q);
        data.M.triangularView<Eigen::StrictlyLower>() = RecordedMatrix::Zero(n, n);
        return in_a_row({data.M});
    }
    if (function == "forward_jacobian") {
        pinocchio::computeABADerivatives(model, data, q, v, last, Dq, Dv, Da);
        return in_a_row({Dq, Dv});
    }
    pinocchio::computeRNEADerivatives(model, data, q, v, last, Dq, Dv, Da);
    Da.triangularView<Eigen::StrictlyLower>() = RecordedMatrix::Zero(n, n);
    return in_a_row({Dq, Dv, Da});
}

int generate(char** words) {
    const Model model = robot_of(words[0], std::string(words[1]) == "floating").model;
    RecordedVector x = RecordedVector::Zero(3 * model.nv);
    CppAD::Independent(x);
    const RecordedVector y = values(words[2], model, x);
    CppAD::ADFun<Code> recorded(x, y);
    recorded.optimize("no_compare_op");
    CppAD::cg::ModelCSourceGen<double> source(recorded, words[2]);
    source.setCreateForwardZero(true);
    source.setMaxAssignmentsPerFunc(static_cast<std::size_t>(std::atoi(words[3])));
    CppAD::cg::ModelLibraryCSourceGen<double> library(source);
    CppAD::cg::SaveFilesModelLibraryProcessor<double>(library).saveSourcesTo(words[4]);
    return 0;
}

}  // namespace

int main(int count, char** words) try {
    if (count == 6) return generate(words + 1);
    std::cerr << "usage: pinocchio_code ROBOT fixed|floating FUNCTION LENGTH FOLDER\n";
    return 3;
} catch (const std::exception& error) {
    std::cerr << "pinocchio_code: " << error.what() << '\n';
    return 1;
}

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Vectors of three components and symmetric 3×3 matrices over any scalar: numbers, expressions, nodes of a
/// program.
///
///     const Triple<double> v = turned_about_z(c, s, Triple<double>{1, 0, 0});     // (c, s, 0)
///
/// A scalar has + − · / and unary −, can be made from small numbers, and drops zeros by itself if it is symbolic.
/// Therefore planar motion, axes along x, y or z and rotations by right angles give short results without special
/// cases.

#include <array>

namespace alembert {

template <typename S>
using Triple = std::array<S, 3>;
template <typename S>
using Matrix = std::array<Triple<S>, 3>;  ///< rows

/// The elements xx yy zz xy yz zx.
template <typename S>
using Symmetric = std::array<S, 6>;

/// The place of element (i, j) of a symmetric matrix.
constexpr int place(int i, int j) {
    return i == j ? i : i + j == 1 ? 3 : i + j == 3 ? 4 : 5;
}

template <typename S>
Triple<S> no_vector() {
    return {S(0), S(0), S(0)};
}
template <typename S>
Symmetric<S> no_matrix() {
    return {S(0), S(0), S(0), S(0), S(0), S(0)};
}

template <typename S>
Triple<S> operator+(const Triple<S>& a, const Triple<S>& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <typename S>
Triple<S> operator-(const Triple<S>& a, const Triple<S>& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <typename S>
Triple<S> operator-(const Triple<S>& a) {
    return {-a[0], -a[1], -a[2]};
}
template <typename S>
Triple<S> operator*(const S& k, const Triple<S>& a) {
    return {k * a[0], k * a[1], k * a[2]};
}
template <typename S>
S dot(const Triple<S>& a, const Triple<S>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <typename S>
Triple<S> cross(const Triple<S>& a, const Triple<S>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <typename S>
Triple<S> operator*(const Matrix<S>& R, const Triple<S>& v) {
    return {dot(R[0], v), dot(R[1], v), dot(R[2], v)};
}
template <typename S>
Matrix<S> transposed(const Matrix<S>& R) {
    Matrix<S> result = R;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) result[i][j] = R[j][i];
    return result;
}
template <typename S>
Matrix<S> operator*(const Matrix<S>& A, const Matrix<S>& B) {
    const Matrix<S> columns = transposed(B);
    return transposed(Matrix<S>{A * columns[0], A * columns[1], A * columns[2]});
}
template <typename S>
Symmetric<S> operator+(const Symmetric<S>& a, const Symmetric<S>& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5]};
}
template <typename S>
Triple<S> operator*(const Symmetric<S>& A, const Triple<S>& v) {
    return {A[0] * v[0] + A[3] * v[1] + A[5] * v[2], A[3] * v[0] + A[1] * v[1] + A[4] * v[2],
            A[5] * v[0] + A[4] * v[1] + A[2] * v[2]};
}

/// R A Rᵀ
template <typename S>
Symmetric<S> congruent(const Matrix<S>& R, const Symmetric<S>& A) {
    const Matrix<S> T{A * R[0], A * R[1], A * R[2]};  // A Rᵀ by columns
    return {dot(R[0], T[0]), dot(R[1], T[1]), dot(R[2], T[2]), dot(R[0], T[1]), dot(R[1], T[2]), dot(R[2], T[0])};
}
template <typename S>
Matrix<S> congruent(const Matrix<S>& R, const Matrix<S>& A) {
    const Matrix<S> T = transposed(Matrix<S>{A * R[0], A * R[1], A * R[2]});  // A Rᵀ
    return R * T;
}

/// The vector turned about z by the angle with this cosine and sine.
template <typename S>
Triple<S> turned_about_z(const S& c, const S& s, const Triple<S>& v) {
    return {c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]};
}
template <typename S>
Triple<S> turned_back(const S& c, const S& s, const Triple<S>& v) {
    return {c * v[0] + s * v[1], c * v[1] - s * v[0], v[2]};
}
/// The same for a symmetric matrix. With a = s (xx − yy) + 2c xy its elements are xx − s a, yy + s a, c a − xy.
template <typename S>
Symmetric<S> turned_about_z(const S& c, const S& s, const Symmetric<S>& A) {
    const S a = s * (A[0] - A[1]) + c * (A[3] + A[3]), sa = s * a;
    return {A[0] - sa, A[1] + sa, A[2], c * a - A[3], s * A[5] + c * A[4], c * A[5] - s * A[4]};
}
template <typename S>
Symmetric<S> turned_about_x(const S& c, const S& s, const Symmetric<S>& A) {
    const S a = s * (A[1] - A[2]) + c * (A[4] + A[4]), sa = s * a;
    return {A[0], A[1] - sa, A[2] + sa, c * A[3] - s * A[5], c * a - A[4], s * A[3] + c * A[5]};
}
template <typename S>
Matrix<S> turned_about_z(const S& c, const S& s, const Matrix<S>& A) {
    Matrix<S> T = A;  // A Rᵀ
    for (Triple<S>& row : T) row = turned_about_z(c, s, row);
    const Matrix<S> columns = transposed(T);
    return transposed(Matrix<S>{turned_about_z(c, s, columns[0]), turned_about_z(c, s, columns[1]),
                                turned_about_z(c, s, columns[2])});
}

/// r × (each column of A), and (each row of A) × … : r̃ A.
template <typename S>
Matrix<S> tilde_times(const Triple<S>& r, const Matrix<S>& A) {
    const Matrix<S> columns = transposed(A);
    return transposed(Matrix<S>{cross(r, columns[0]), cross(r, columns[1]), cross(r, columns[2])});
}
template <typename S>
Matrix<S> full(const Symmetric<S>& A) {
    return {Triple<S>{A[0], A[3], A[5]}, Triple<S>{A[3], A[1], A[4]}, Triple<S>{A[5], A[4], A[2]}};
}

}  // namespace alembert

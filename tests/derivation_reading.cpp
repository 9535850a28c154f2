// SPDX-License-Identifier: GPL-2.0-or-later
// Hand derivations in LaTeX, Markdown and plain text become trees. Each formula is held against the normalized
// LaTeX of its tree, which itself must be read as the same tree.

#include <doctest/doctest.h>

#include <ctime>
#include <random>
#include <string>
#include <vector>

#include "alembert/base/error.hpp"
#include "check/written/read.hpp"

using namespace alembert;

namespace {

Written written(const std::string& text, const std::string& file = "test.md") {
    return read_derivation(text, file);
}

/// "a = b ~ c", or "not: " and the reason.
std::string in_one_line(const WrittenStatement& statement) {
    if (statement.sides.empty()) return "not: " + statement.reason;
    std::string text;
    for (std::size_t k = 0; k < statement.sides.size(); ++k) {
        static constexpr const char* signs[] = {" = ", " ~ ", " := ", " < "};
        if (k > 0) text += signs[static_cast<int>(statement.relations[k - 1])];
        text += latex(*statement.sides[k]);
    }
    return text;
}

/// All statements, between " | ".
std::string all(const std::string& text, const std::string& file = "test.md") {
    std::string result;
    try {
        for (const WrittenStatement& one : written(text, file).statements)
            result += (result.empty() ? "" : " | ") + in_one_line(one);
    } catch (const SceneError& error) {
        return "error: " + error.diagnostics.at(0).message;
    }
    return result;
}

std::string display(const std::string& formula) {
    return all("$$" + formula + "$$");
}

struct Row {
    const char* text;
    const char* expected;
};

void check_rows(const std::vector<Row>& rows, std::string (*read)(const std::string&)) {
    for (const Row& row : rows) {
        CAPTURE(row.text);
        CHECK(read(row.text) == row.expected);
    }
}

std::string plain(const std::string& text) {
    return all(text, "test.txt");
}

bool same(const Math& a, const Math& b) {
    if (a.kind != b.kind || a.text != b.text || a.letter != b.letter || a.dots != b.dots ||
        a.args.size() != b.args.size())
        return false;
    for (std::size_t k = 0; k < a.args.size(); ++k)
        if (!same(*a.args[k], *b.args[k])) return false;
    return true;
}

/// Each side, printed, is read as the same tree.
void check_printed(const std::string& text, const std::string& file = "test.md") {
    for (const WrittenStatement& statement : written(text, file).statements)
        for (const MathPtr& side : statement.sides) {
            const std::string printed = latex(*side);
            CAPTURE(printed);
            const Written again = written("$$" + printed + "$$");
            REQUIRE(again.statements.size() == 1);
            CAPTURE(again.statements[0].reason);
            REQUIRE(again.statements[0].sides.size() == 1);
            CHECK(same(*again.statements[0].sides[0], *side));
        }
}

/// Offsets lie in the document, and parts lie in the whole where they are of the same formula.
void check_places(const Math& math, const std::string& text) {
    CHECK(math.offset + math.length <= text.size());
    for (const MathPtr& one : math.args) check_places(*one, text);
}

const std::vector<Row> latex_rows = {
    {R"x(\frac{1}{2} m v^2)x", R"x(\frac{1}{2} m v^{2})x"},
    {R"x(\dfrac{1}{2}m\dot{x}^2)x", R"x(\frac{1}{2} m \dot{x}^{2})x"},
    {R"x(\tfrac12 m l^2\dot\theta^2)x", R"x(\frac{1}{2} m l^{2} \dot{\theta}^{2})x"},
    {R"x(\frac1{2}ml^2)x", R"x(\frac{1}{2} m l^{2})x"},
    {R"x(\frac 12ml^2)x", R"x(\frac{1}{2} m l^{2})x"},
    {R"x(\dot{\theta}_1^2)x", R"x(\dot{\theta}_{1}^{2})x"},
    {R"x(\dot\theta_1)x", R"x(\dot{\theta}_{1})x"},
    {R"x(\dot{\theta_1})x", R"x(\dot{\theta}_{1})x"},
    {R"x(\dot{x}^{2}_{1})x", R"x(\dot{x}_{1}^{2})x"},
    {R"x(\ddot{x})x", R"x(\ddot{x})x"},
    {R"x(\dddot x)x", R"x(\dddot{x})x"},
    {R"x(\theta')x", R"x(\dot{\theta})x"},
    {R"x(\theta_1'')x", R"x(\ddot{\theta}_{1})x"},
    {R"x(\frac{d}{dt}(m\dot x))x", R"x(\frac{d}{d t}\left(m \dot{x}\right))x"},
    {R"x(\dfrac{d}{dt}\frac{\partial L}{\partial \dot\theta})x",
     R"x(\frac{d}{d t}\left(\frac{\partial L}{\partial \dot{\theta}}\right))x"},
    {R"x(\frac{d}{dt}\left(\frac{\partial T}{\partial\dot q}\right))x",
     R"x(\frac{d}{d t}\left(\frac{\partial T}{\partial \dot{q}}\right))x"},
    {R"x(\frac{d}{dt} m l^2\dot\theta - m g)x", R"x(\frac{d}{d t}\left(m l^{2} \dot{\theta}\right) - m g)x"},
    {R"x(\frac{\mathrm d}{\mathrm dt}\frac{\partial L}{\partial\dot x})x",
     R"x(\frac{d}{d t}\left(\frac{\partial L}{\partial \dot{x}}\right))x"},
    {R"x(\frac{\mathrm{d}}{\mathrm{d}t}\left(m v\right))x", R"x(\frac{d}{d t}\left(m v\right))x"},
    {R"x(\frac{{\rm d}}{{\rm d}t} x)x", R"x(\dot{x})x"},
    {R"x(\partial L/\partial\theta)x", R"x(\frac{\partial L}{\partial \theta})x"},
    {R"x(\frac{\partial^2 T}{\partial\dot q\,\partial q})x",
     R"x(\frac{\partial^{2} T}{\partial \dot{q} \partial q})x"},
    {R"x(\frac{\partial^2 V}{\partial x^2})x", R"x(\frac{\partial^{2} V}{\partial x \partial x})x"},
    {R"x(\frac{\partial}{\partial\dot{x_i}}L)x", R"x(\frac{\partial L}{\partial \dot{x}_{i}})x"},
    {R"x(\frac{d^2\theta}{dt^2})x", R"x(\ddot{\theta})x"},
    {R"x(\frac{d\theta}{dt})x", R"x(\dot{\theta})x"},
    {R"x(\frac{d^2}{dt^2}(x+y))x", R"x(\frac{d^{2}}{d t^{2}}\left(x + y\right))x"},
    {R"x(d\theta/dt)x", R"x(\dot{\theta})x"},
    {R"x(d^2\theta/dt^2)x", R"x(\ddot{\theta})x"},
    {R"x(\frac{dV}{d\theta})x", R"x(\frac{d V}{d \theta})x"},
    {R"x(\dv{x}{t})x", R"x(\dot{x})x"},
    {R"x(\dv[2]{x}{t})x", R"x(\ddot{x})x"},
    {R"x(\dv{t}\pdv{L}{\dot q})x", R"x(\frac{d}{d t}\left(\frac{\partial L}{\partial \dot{q}}\right))x"},
    {R"x(\dv{}{t}\left(\pdv{L}{\dot q}\right))x",
     R"x(\frac{d}{d t}\left(\frac{\partial L}{\partial \dot{q}}\right))x"},
    {R"x(\pdv{L}{q})x", R"x(\frac{\partial L}{\partial q})x"},
    {R"x(\frac{d}{2} + \frac{d_1}{d_2})x", R"x(\frac{d}{2} + \frac{d_{1}}{d_{2}})x"},
    {R"x(\frac{d}{d t} \theta{\left(t \right)})x", R"x(\dot{\theta})x"},
    {R"x(\frac{d^{2}}{d t^{2}} \theta{\left(t \right)})x", R"x(\ddot{\theta})x"},
    {R"x(\frac{\partial}{\partial \frac{d}{d t} \theta{\left(t \right)}} L)x",
     R"x(\frac{\partial L}{\partial \dot{\theta}})x"},
    {R"x(L_{\dot\theta})x", R"x(L_{\dot{\theta}})x"},
    {R"x(\partial_q L)x", R"x(\frac{\partial L}{\partial q})x"},
    {R"x(\sin^2\theta)x", R"x(\left(\sin\left(\theta\right)\right)^{2})x"},
    {R"x(\sin^{2}(\theta))x", R"x(\left(\sin\left(\theta\right)\right)^{2})x"},
    {R"x(\sin^{-1} x)x", R"x(\arcsin\left(x\right))x"},
    {R"x(\sin\theta\cos\theta)x", R"x(\sin\left(\theta\right) \cos\left(\theta\right))x"},
    {R"x(\sin 2\theta)x", R"x(\sin\left(2 \theta\right))x"},
    {R"x(\sin\tfrac12\theta)x", R"x(\sin\left(\frac{1}{2} \theta\right))x"},
    {R"x(\sin(\theta_1-\theta_2))x", R"x(\sin\left(\theta_{1} - \theta_{2}\right))x"},
    {R"x(\sin{\left(\theta{\left(t \right)} \right)})x", R"x(\sin\left(\theta\left(t\right)\right))x"},
    {R"x(\sin\left(2\theta\right)^2)x", R"x(\left(\sin\left(2 \theta\right)\right)^{2})x"},
    {R"x(\cos\theta_1 \dot\theta_1)x", R"x(\cos\left(\theta_{1}\right) \dot{\theta}_{1})x"},
    {R"x(\cos\theta\,\dot\theta\,m)x", R"x(\cos\left(\theta\right) \dot{\theta} m)x"},
    {R"x(\sin\omega t)x", R"x(\sin\left(\omega t\right))x"},
    {R"x(\sin\omega_0 t + x)x", R"x(\sin\left(\omega_{0} t\right) + x)x"},
    {R"x(\cos n\varphi)x", R"x(\cos\left(n \varphi\right))x"},
    {R"x(\cos\theta(\dot x + l))x", R"x(\cos\left(\theta\right) \left(\dot{x} + l\right))x"},
    {R"x(\ln|x|)x", R"x(\ln\left(\operatorname{abs}\left(x\right)\right))x"},
    {R"x(mgl \cos\theta)x", R"x(m g l \cos\left(\theta\right))x"},
    {R"x(mglsin\theta)x", R"x(m g l \sin\left(\theta\right))x"},
    {R"x(\cos\frac{\theta}{2})x", R"x(\cos\left(\frac{\theta}{2}\right))x"},
    {R"x(\left[ a + b \right] c)x", R"x(\left(a + b\right) c)x"},
    {R"x(\bigl[ a + b \bigr] c)x", R"x(\left(a + b\right) c)x"},
    {R"x(\Big\{ a + b \Big\}^2)x", R"x(\left(a + b\right)^{2})x"},
    {R"x(|\vec v|^2)x", R"x(\left(\operatorname{abs}\left(\vec{v}\right)\right)^{2})x"},
    {R"x(\left|x\right|)x", R"x(\operatorname{abs}\left(x\right))x"},
    {R"x(\lvert v\rvert)x", R"x(\operatorname{abs}\left(v\right))x"},
    {R"x(\|\mathbf{v}\|^2)x", R"x(\left(\operatorname{abs}\left(\mathbf{v}\right)\right)^{2})x"},
    {R"x(\norm{\vec v})x", R"x(\operatorname{abs}\left(\vec{v}\right))x"},
    {R"x(m \cdot g \cdot h)x", R"x(m \cdot g \cdot h)x"},
    {R"x(2 \times 3)x", R"x(2 \times 3)x"},
    {R"x(\vec r \times \vec F)x", R"x(\vec{r} \times \vec{F})x"},
    {R"x(\mathbf F \cdot \mathbf v)x", R"x(\mathbf{F} \cdot \mathbf{v})x"},
    {R"x(\sqrt{g/l})x", R"x(\sqrt{\frac{g}{l}})x"},
    {R"x(\sqrt[3]{x})x", R"x(x^{\frac{1}{3}})x"},
    {R"x(\sqrt2 x)x", R"x(\sqrt{2} x)x"},
    {R"x(\mathbf{r}_C)x", R"x(\mathbf{r}_{C})x"},
    {R"x(\boldsymbol{\omega})x", R"x(\mathbf{\omega})x"},
    {R"x(\vec{AB})x", R"x(\vec{\mathrm{AB}})x"},
    {R"x(\hat{\mathbf{i}})x", R"x(\hat{i})x"},
    {R"x(\mathcal{L})x", R"x(\mathcal{L})x"},
    {R"x(\mathrm{mp} \, g)x", R"x(\mathrm{mp} g)x"},
    {R"x(\operatorname{sgn}(x))x", R"x(\operatorname{sign}\left(x\right))x"},
    {R"x(\dot{\vec r})x", R"x(\dot{\vec{r}})x"},
    {R"x(\dot{(x+y)})x", R"x(\frac{d}{d t}\left(x + y\right))x"},
    {R"x(\begin{pmatrix} l\sin\theta \\ -l\cos\theta \end{pmatrix})x",
     R"x(\begin{pmatrix}l \sin\left(\theta\right) \\ -l \cos\left(\theta\right)\end{pmatrix})x"},
    {R"x(\begin{bmatrix} a & b \\ c & d \end{bmatrix})x", R"x(\begin{pmatrix}a & b \\ c & d\end{pmatrix})x"},
    {R"x(\left(\begin{array}{cc} a & b \\ c & d \end{array}\right))x",
     R"x(\begin{pmatrix}a & b \\ c & d\end{pmatrix})x"},
    {R"x(\begin{bmatrix} s & \theta \end{bmatrix}^\top)x", R"x(\begin{pmatrix}s \\ \theta\end{pmatrix})x"},
    {R"x(\left( x, y \right))x", R"x(\begin{pmatrix}x \\ y\end{pmatrix})x"},
    {R"x(\langle x, y\rangle)x", R"x(\begin{pmatrix}x \\ y\end{pmatrix})x"},
    {R"x(x\,\mathbf i + y\,\mathbf j)x", R"x(x \mathbf{i} + y \mathbf{j})x"},
    {R"x(F(t))x", R"x(F\left(t\right))x"},
    {R"x(V(r))x", R"x(V\left(r\right))x"},
    {R"x(L(q, \dot q, t))x", R"x(L\left(q, \dot{q}, t\right))x"},
    {R"x(L(q_1,\dots,q_n,t))x", R"x(L\left(q_{1}, \mathrm{dots}, q_{n}, t\right))x"},
    {R"x(\dot\theta(t))x", R"x(\dot{\theta})x"},
    {R"x(x(t=0))x", R"x(x\left(0\right))x"},
    {R"x(x_1[0] + \bold{U})x", R"x(x_{1}\left(0\right) + \mathbf{U})x"},
    {R"x(m(g+a))x", R"x(m\left(g + a\right))x"},
    {R"x(m(g+a)^2)x", R"x(m\left(g + a\right)^{2})x"},
    {R"x(T^{\text{particle M1}})x", R"x(T^{\text{particle M1}})x"},
    {R"x(Q_{\theta_1}^{\text{force 1 at M2}})x", R"x(Q_{\theta_{1}}^{\text{force 1 at M2}})x"},
    {R"x(v^{C} + x^{*} + q^{(1)} + x^n)x", R"x(v^{\text{C}} + x^{*} + q^{\text{(1)}} + x^{n})x"},
    {R"x(F*_{v} + F^{*}_v)x", R"x(F_{v}^{*} + F_{v}^{*})x"},
    {R"x({}^{N}\omega^{B})x", R"x(\omega^{\text{N,B}})x"},
    {R"x(\lambda_1)x", R"x(\lambda_{1})x"},
    {R"x(\lambda_{\mathrm{mesh\_y}})x", R"x(\lambda_{\text{mesh_y}})x"},
    {R"x(I_{zz} + x_{1,2} + v_{C/A})x", R"x(I_{\text{zz}} + x_{1,2} + v_{\text{C/A}})x"},
    {R"x(x_\text{cm} + x_{\rm cm})x", R"x(x_{\text{cm}} + x_{\text{cm}})x"},
    {R"x(\theta_10)x",
     R"x(not: two numbers stand beside each other; expected a sign between them, or braces around an index or exponent of several digits)x"},
    {R"x(\delta W)x", R"x(\delta W)x"},
    {R"x(\delta\theta)x", R"x(\delta \theta)x"},
    {R"x(\ddot x + 2\delta\dot x)x", R"x(\ddot{x} + 2 \delta \dot{x})x"},
    {R"x(\delta_0)x", R"x(\delta_{0})x"},
    {R"x(\Delta l)x", R"x(\Delta l)x"},
    {R"x(dW = Q\,dq)x", R"x(\mathrm{d}W = Q \mathrm{d}q)x"},
    {R"x(d + d x)x", R"x(d + d x)x"},
    {R"x(9.81\,\mathrm{m/s^2})x", R"x(9.81\,\mathrm{m/s^2})x"},
    {R"x(9.81~\mathrm{m}/\mathrm{s}^2)x", R"x(9.81\,\mathrm{m/s^2})x"},
    {R"x(9.81\,\mathrm{m\,s^{-2}})x", R"x(9.81\,\mathrm{m s^-2})x"},
    {R"x(5\text{ kg})x", R"x(5\,\mathrm{kg})x"},
    {R"x(\SI{9.81}{\metre\per\second\squared})x", R"x(9.81\,\mathrm{m/s^2})x"},
    {R"x(\qty{2.5}{kg})x", R"x(2.5\,\mathrm{kg})x"},
    {R"x(\qty(\pdv{L}{q}))x", R"x(\frac{\partial L}{\partial q})x"},
    {R"x(30^\circ)x", R"x(30\,\mathrm{deg})x"},
    {R"x(\cos(3\psi))x", R"x(\cos\left(3 \psi\right))x"},
    {R"x(3\,\mathrm{psi})x", R"x(3\,\mathrm{psi})x"},
    {R"x(45^{\circ} + x)x", R"x(45\,\mathrm{deg} + x)x"},
    {R"x(12 \, \mathrm{EI} \, q)x", R"x(12 \mathrm{EI} q)x"},
    {R"x(9{,}81)x", R"x(9.81)x"},
    {R"x(p^2/2m)x", R"x(\frac{p^{2}}{2 m})x"},
    {R"x(g/l\sin\theta)x", R"x(\frac{g}{l} \sin\left(\theta\right))x"},
    {R"x(a/b c)x", R"x(\frac{a}{b} c)x"},
    {R"x(1/2 m v^2)x", R"x(\frac{1}{2} m v^{2})x"},
    {R"x(mgl/2 \sin\theta)x", R"x(\frac{m g l}{2} \sin\left(\theta\right))x"},
    {R"x(\underbrace{m g}_{\text{weight}} + x)x", R"x(m g + x)x"},
    {R"x(\overbrace{a}^{b})x", R"x(a)x"},
    {R"x(\cancel{m} g)x", R"x(m g)x"},
    {R"x(\color{red}{x} + \textcolor{blue}{y})x", R"x(x + y)x"},
    {R"x(\phantom{x} y)x", R"x(y)x"},
    {R"x(\boxed{\ddot x = -g})x", R"x(\ddot{x} = -g)x"},
    {R"x(\stackrel{!}{=} 0)x", R"x(not: nothing stands on one side of a sign such as =; expected an expression)x"},
    {R"x(a \overset{!}{=} b)x", R"x(a = b)x"},
    {R"x(a = b \neq c)x", R"x(a = b < c)x"},
    {R"x(\ddot\theta \approx -\omega^2\theta \simeq x)x", R"x(\ddot{\theta} ~ -\omega^{2} \theta ~ x)x"},
    {R"x(\omega^2 := g/l \equiv \omega_0^2)x", R"x(\omega^{2} := \frac{g}{l} := \omega_{0}^{2})x"},
    {R"x(F \propto x)x", R"x(F < x)x"},
    {R"x(a = b \implies c = d)x", R"x(a = b | c = d)x"},
    {R"x(a = b \Rightarrow c = d)x", R"x(a = b | c = d)x"},
    {R"x(\therefore a = b)x", R"x(a = b)x"},
    {R"x(a = b, \quad c = d)x", R"x(a = b | c = d)x"},
    {R"x(a = b \quad c = d)x", R"x(a = b | c = d)x"},
    {R"x(a = b \text{ and } c = d)x", R"x(a = b | c = d)x"},
    {R"x(a = b;\; c = d.)x", R"x(a = b | c = d)x"},
    {R"x(a = b \qquad (1.3))x", R"x(a = b)x"},
    {R"x(a = b \tag{2} \label{eq})x", R"x(a = b)x"},
    {R"x(a = b \quad \text{for } x > 0)x", R"x(a = b)x"},
    {R"x(a = 0, \quad i = 1, 2)x", R"x(a = 0)x"},
    {R"x(a_i = 0 \quad \text{for} \quad i = 1,\ldots,n)x", R"x(a_{i} = 0)x"},
    {R"x(E = \text{const})x", R"x(E = \mathrm{const})x"},
    {R"x(\text{KE} = \frac12 m v^2)x", R"x(\mathrm{KE} = \frac{1}{2} m v^{2})x"},
    {R"x(p = m\dot x = \text{const} \quad \text{(momentum is conserved)})x",
     R"x(p = m \dot{x} = \mathrm{const})x"},
    {R"x(H = \sum_{i=1}^n p_i\dot q_i - L)x", R"x(H = \sum_{\text{i=1}}^{\text{n}} p_{i} \dot{q}_{i} - L)x"},
    {R"x(S = \int_{t_1}^{t_2} L\,dt)x", R"x(S = \int_{\text{t_1}}^{\text{t_2}} L \mathrm{d}t)x"},
    {R"x(e^{-ct}\cos\omega t)x", R"x(e^{-c t} \cos\left(\omega t\right))x"},
    {R"x({a \over b})x", R"x(\frac{a}{b})x"},
    {R"x(x^{-1})x", R"x(x^{-1})x"},
    {R"x(\mathbf{\dot r})x", R"x(\dot{\mathbf{r}})x"},
    {R"x(\left.\frac{\partial L}{\partial q}\right|_{0})x",
     R"x(not: a value at a place, |_…, was found; expected the value written out)x"},
    {R"x(\frac{\partial V}{\partial\theta}\Big|_{\theta=0})x",
     R"x(not: a value at a place, |_…, was found; expected the value written out)x"},
    {R"x(x = \pm a)x", R"x(not: a sign with two meanings, ±, was found; expected one equation for each sign)x"},
    {R"x(a = )x", R"x(not: nothing stands on one side of a sign such as =; expected an expression)x"},
    {R"x( = b)x", R"x(not: nothing stands on one side of a sign such as =; expected an expression)x"},
    {R"x(\foo x)x", R"x(not: '\foo' is not known in a formula; expected a term)x"},
    {R"x(x = \write18{ls})x",
     R"x(not: '\write' is refused: nothing is executed, and no other file is read; expected formulas written out)x"},
    {R"x(\frac{\partial L}{x)x", R"x(not: a bracket is opened here and not closed; expected its other half)x"},
    {R"x(a + \cdots + b)x", R"x(not: an ellipsis was found; expected a term)x"},
    {R"x(2 3)x",
     R"x(not: two numbers stand beside each other; expected a sign between them, or braces around an index or exponent of several digits)x"},
    {R"x(\partial)x",
     R"x(error: no mathematics was found; expected formulas in $…$, \[…\] or align, or lines such as T = 1/2*m*v^2)x"},
};

const std::vector<Row> plain_rows = {
    {R"x(theta'' = -g/l*sin(theta))x", R"x(\ddot{\theta} = -\frac{g}{l} \sin\left(\theta\right))x"},
    {R"x(theta1'' + m1 = 0)x", R"x(\ddot{\theta}_{1} + m_{1} = 0)x"},
    {R"x(T = 1/2 m (x'^2 + y'^2))x", R"x(T = \frac{1}{2} m\left(\dot{x}^{2} + \dot{y}^{2}\right))x"},
    {R"x(T = 1/2*m*l**2*theta'**2)x", R"x(T = \frac{1}{2} m l^{2} \dot{\theta}^{2})x"},
    {R"x(V = -m*g*l*cos(theta))x", R"x(V = -m g l \cos\left(\theta\right))x"},
    {R"x(E = p^2/2m)x", R"x(E = \frac{p^{2}}{2 m})x"},
    {R"x(mgl = 2 m l)x", R"x(\mathrm{mgl} = 2 m l)x"},
    {R"x(E = mgh.)x", R"x(E = \mathrm{mgh})x"},
    {R"x(theta_ddot = -(g/l)*sin(theta))x", R"x(\ddot{\theta} = -\frac{g}{l} \sin\left(\theta\right))x"},
    {R"x(thetaddot = -theta1_dot + thetadot_2 + xdot)x",
     R"x(\ddot{\theta} = -\dot{\theta}_{1} + \dot{\theta}_{2} + \dot{x})x"},
    {R"x(Derivative(theta(t), (t, 2)) = 0)x", R"x(\ddot{\theta} = 0)x"},
    {R"x(Derivative(L, Derivative(theta(t), t)) = m)x", R"x(\frac{\partial L}{\partial \dot{\theta}} = m)x"},
    {R"x(Derivative(theta(t), t, t) = Derivative(x(t), t)**2)x", R"x(\ddot{\theta} = \dot{x}^{2})x"},
    {R"x(Eq(m*Derivative(x(t), (t, 2)), -k*x(t)))x", R"x(m \ddot{x} = -k x\left(t\right))x"},
    {R"x(Rational(1, 2)*m = x.diff(t))x", R"x(\frac{1}{2} m = \dot{x})x"},
    {R"x(theta.diff(t, 2) = 0)x", R"x(\ddot{\theta} = 0)x"},
    {R"x(th''[t] + g/l Sin[th[t]] == 0)x",
     R"x(\ddot{\mathrm{th}} + \frac{g}{l} \sin\left(\mathrm{th}\left(t\right)\right) = 0)x"},
    {R"x(D[D[L, th'[t]], t] - D[L, th[t]] == 0)x",
     R"x(\frac{d}{d t}\left(\frac{\partial L}{\partial \dot{\mathrm{th}}}\right) - \frac{\partial L}{\partial \mathrm{th}} = 0)x"},
    {R"x({x'[t] == y[t], y'[t] == -x[t]})x", R"x(\dot{x} = y\left(t\right) | \dot{y} = -x\left(t\right))x"},
    {R"x(\[Theta]''[t] == -g Sin[\[Theta][t]])x", R"x(\ddot{\theta} = -g \sin\left(\theta\left(t\right)\right))x"},
    {R"x(diff(theta(t), t, t) = -g/l*sin(theta(t)))x",
     R"x(\ddot{\theta} = -\frac{g}{l} \sin\left(\theta\left(t\right)\right))x"},
    {R"x(diff(theta(t),t$2) = -g*sin(theta(t))/l)x",
     R"x(\ddot{\theta} = -\frac{g \sin\left(\theta\left(t\right)\right)}{l})x"},
    {R"x(D(theta)(t) = omega)x", R"x(\dot{\theta} = \omega)x"},
    {R"x(diff(L, diff(theta(t), t)) = m*l.^2.*x)x", R"x(\frac{\partial L}{\partial \dot{\theta}} = m l^{2} x)x"},
    {R"x(d/dt(dL/dtheta') - dL/dtheta = 0)x",
     R"x(\frac{d}{d t}\left(\frac{d L}{d \dot{\theta}}\right) - \frac{d L}{d \theta} = 0)x"},
    {R"x(d^2theta/dt^2 = dx/dt)x", R"x(\ddot{\theta} = \dot{x})x"},
    {R"x(T = ½ m l² θ̇²)x", R"x(T = \frac{1}{2} m l^{2} \dot{\theta}^{2})x"},
    {R"x(θ̈₁ + (g/l) sin θ₁ = 0)x", R"x(\ddot{\theta}_{1} + \frac{g}{l} \sin\left(\theta_{1}\right) = 0)x"},
    {R"x(∂L/∂θ̇ = ml²θ̇)x", R"x(\frac{\partial L}{\partial \dot{\theta}} = \mathrm{ml}^{2} \dot{\theta})x"},
    {R"x(d/dt(∂L/∂θ̇) − ∂L/∂θ = 0)x",
     R"x(\frac{d}{d t}\left(\frac{\partial L}{\partial \dot{\theta}}\right) - \frac{\partial L}{\partial \theta} = 0)x"},
    {R"x(d²θ/dt² + ω₀² θ = 0)x", R"x(\ddot{\theta} + \omega_{0}^{2} \theta = 0)x"},
    {R"x(v² = ẋ² + ẏ²)x", R"x(v^{2} = \dot{x}^{2} + \dot{y}^{2})x"},
    {R"x(m ẍ = −k·x)x", R"x(m \ddot{x} = -k \cdot x)x"},
    {R"x(𝑚𝑥̈ = −𝑘𝑥)x", R"x(m \ddot{x} = -k x)x"},
    {R"x(L = √(g/l) × 2)x", R"x(L = \sqrt{\frac{g}{l}} \times 2)x"},
    {R"x(ℒ = T − V)x", R"x(\mathcal{L} = T - V)x"},
    {R"x(H = Σᵢ pᵢq̇ᵢ − L)x", R"x(H = \sum_{\text{i}} p_{i} \dot{q}_{i} - L)x"},
    {R"x(x = ¾ a)x", R"x(x = \frac{3}{4} a)x"},
    {R"x(a ≈ b ≡ c)x", R"x(a ~ b := c)x"},
    {R"x(ω² = k/m ⇒ ω = √(k/m))x", R"x(\omega^{2} = \frac{k}{m} | \omega = \sqrt{\frac{k}{m}})x"},
    {R"x(sin²θ + cos²θ = 1)x",
     R"x(\left(\sin\left(\theta\right)\right)^{2} + \left(\cos\left(\theta\right)\right)^{2} = 1)x"},
    {R"x(The total energy is E = 1/2*m*v**2 + m*g*h, which is conserved.)x",
     R"x(E = \frac{1}{2} m v^{2} + m g h)x"},
    {R"x(The momentum p = m v; the energy E = p^2/2m.)x", R"x(p = m v | E = \frac{p^{2}}{2 m})x"},
    {R"x(L = T − V (kinetic minus potential))x", R"x(L = T - V)x"},
    {R"x(J_CM = (1/12)MR^2    (rod about center of mass))x", R"x(J_{\text{CM}} = \frac{1}{12} \mathrm{MR}^{2})x"},
    {R"x(x_{1} = l_{1} \sin \theta _{1} , y_{1} = l_{1} \cos \theta _{1} , (1.120))x",
     R"x(x_{1} = l_{1} \sin\left(\theta_{1}\right) | y_{1} = l_{1} \cos\left(\theta_{1}\right))x"},
    {R"x(g = 9.81 m/s^2, m = 2 kg)x", R"x(g = 9.81\,\mathrm{m/s^2} | m = 2\,\mathrm{kg})x"},
    {R"x(x = 2 m)x", R"x(x = 2 m)x"},
    {R"x(mLθ'' + mgLsinθ - ak(θ1 - θ2) = 0)x",
     R"x(\mathrm{mL} \ddot{\theta} + \mathrm{mgL} \sin\left(\theta\right) - \mathrm{ak}\left(\theta_{1} - \theta_{2}\right) = 0)x"},
    {R"x(force = mass * acceleration)x", R"x(\mathrm{force} = \mathrm{mass} \mathrm{acceleration})x"},
    {R"x(T = a +)x", R"x(not: the end of the formula was found; expected a term)x"},
};

const std::vector<Row> documents = {
    {R"x(\begin{align} T &= \frac12 m v^2 \\ &= \frac12 m l^2\dot\theta^2 \\ V &= m g h \end{align})x",
     R"x(T = \frac{1}{2} m v^{2} = \frac{1}{2} m l^{2} \dot{\theta}^{2} | V = m g h)x"},
    {R"x(\begin{align*} E &= a \\ &\quad + b \\ &{}- c \end{align*})x", R"x(E = a + b - c)x"},
    {R"x(\begin{align*} &2 a \\ &\quad + b = 0 \\ &- c \\ &\quad + d = 0 \end{align*})x",
     R"x(2 a + b = 0 | -c + d = 0)x"},
    {R"x(\begin{align} a &= b & c &= d \\ e &= f && \text{(a remark)} \end{align})x",
     R"x(a = b | c = d | e = f)x"},
    {R"x(\begin{eqnarray} a &=& b \\ &=& c \end{eqnarray})x", R"x(a = b = c)x"},
    {R"x(\begin{multline} a = b \\ + c \end{multline})x", R"x(a = b + c)x"},
    {R"x(\begin{gather} a = b \\ c = d \end{gather})x", R"x(a = b | c = d)x"},
    {R"x(\begin{equation}\begin{split} a &= b + \left( c \right. \\ &\quad \left. + d \right) \end{split}\end{equation})x",
     R"x(a = b + \left(c + d\right))x"},
    {R"x(\[ \left\{ \begin{aligned} \dot x &= y \\ \dot y &= -x \end{aligned} \right. \])x",
     R"x(\dot{x} = y | \dot{y} = -x)x"},
    {R"x(\[ \begin{cases} \dot x = y \\ \dot y = -x \end{cases} \])x", R"x(\dot{x} = y | \dot{y} = -x)x"},
    {R"x($$ f = \begin{cases} a & x > 0 \\ b & \text{otherwise} \end{cases} $$)x", R"x(f = a | f = b)x"},
    {R"x(\[ \boxed{\begin{aligned} a &= b \\ c &= d \end{aligned}} \])x", R"x(a = b | c = d)x"},
    {R"x(\( a = b \) and \[ c = d \])x", R"x(a = b | c = d)x"},
    {R"x($$a = b +$$
$$+ c$$)x",
     R"x(a = b + c)x"},
    {R"x($$a = b$$
$$= c$$)x",
     R"x(a = b = c)x"},
    {R"x(We find

$$a = b$$

hence

$$= c$$)x",
     R"x(a = b | b = c)x"},
    {R"x(```math
a = b
```

```python
x = foo()
```

```
T = ½ m v²
```)x",
     R"x(a = b | T = \frac{1}{2} m v^{2})x"},
    {R"x(The code `v = a*t` and $`a = b`$ and ``c = d`` and :math:`e = f`.)x",
     R"x(v = a t | a = b | c = d | e = f)x"},
    {R"x(.. math::

   a = b

words)x",
     R"x(a = b)x"},
    {R"x([
m\ddot{x} + kx = 0
]

with the angle (\theta_1).)x",
     R"x(m \ddot{x} + k x = 0 | \theta_{1})x"},
    {R"x(**Kinetic energy:** T = m*v
- V = m*g*h
1. L = T - V
> E = T + V)x",
     R"x(T = m v | V = m g h | L = T - V | E = T + V)x"},
    {R"x(T = a
  = b
  + c
)x",
     R"x(T = a = b + c)x"},
    {R"x(\newcommand{\pd}[2]{\frac{\partial #1}{\partial #2}} \newcommand{\thd}{\dot\theta} $\pd{L}{\thd} = m$)x",
     R"x(\frac{\partial L}{\partial \dot{\theta}} = m)x"},
    {R"x(\input{secret.tex} $a = b$)x",
     R"x(not: '\input' is refused: nothing is executed, and no other file is read; expected formulas written out | a = b)x"},
    {R"x(\def\x{y} $a = b$)x",
     R"x(not: '\def' is refused: nothing is executed, and no other file is read; expected formulas written out | a = b)x"},
    {R"x($a = b$ and $c = d)x", R"x(a = b | not: a formula is opened here by $ and not closed)x"},
    {R"x(\begin{align} a = b)x", R"x(not: the environment 'align' is opened here and not closed)x"},
    {R"x(It costs 5$ or 6$ and $a = b$.)x", R"x(a = b)x"},
    {R"x(no mathematics at all)x",
     R"x(error: no mathematics was found; expected formulas in $…$, \[…\] or align, or lines such as T = 1/2*m*v^2)x"},
};

}  // namespace

TEST_CASE("derivation: formulas in LaTeX are read as mathematicians mean them") {
    check_rows(latex_rows, display);
}

TEST_CASE("derivation: plain text, Unicode and what programs of computer algebra print are read") {
    check_rows(plain_rows, plain);
}

TEST_CASE("derivation: rows, displays, code and words of a document") {
    check_rows(documents, [](const std::string& text) { return all(text); });
    CHECK(all("\\documentclass{article}\n\\newcommand{\\dd}{\\mathrm{d}}\n\\begin{document}\n% $x = "
              "1$\n\\section{Motion $a$}\n"
              "\\begin{itemize}\\item $\\frac{\\dd x}{\\dd t} = v$ % $y$\n\\end{itemize}\\end{document} $z = 1$",
              "test.tex") == "a | \\dot{x} = v");
}

TEST_CASE("derivation: what is printed is read as the same tree") {
    for (const Row& row : latex_rows)
        if (std::string(row.expected).find("error: ") == std::string::npos)
            check_printed("$$" + std::string(row.text) + "$$");
    for (const Row& row : plain_rows) check_printed(row.text, "test.txt");
}

TEST_CASE("derivation: one letter has one name in all notations") {
    const std::vector<std::string> ways = {
        "$\\ddot\\theta_1$",   "$\\ddot{\\theta}_{1}$",        "$\\theta_1''$",   "$θ̈₁$",
        "$\\ddot{\\theta_1}$", "$\\frac{d^2\\theta_1}{dt^2}$", "$\\theta''_{1}$", "$𝜃̈_1$"};
    for (const std::string& way : ways) {
        CAPTURE(way);
        const MathPtr side = written(way).statements.at(0).sides.at(0);
        CHECK(side->kind == Math::Kind::letter);
        CHECK(side->letter == Letter{.base = "theta", .index = "1"});
        CHECK(side->dots == 2);
    }
    for (const std::string way :
         {"theta1'' = 0", "theta_1'' = 0", "theta1_ddot = 0", "theta_ddot_1 = 0", "thetaddot1 = 0",
          "Derivative(theta1(t), (t, 2)) = 0", "diff(theta1, t, t) = 0"}) {
        CAPTURE(way);
        const MathPtr side = written(way, "test.txt").statements.at(0).sides.at(0);
        CHECK(side->letter == Letter{.base = "theta", .index = "1"});
        CHECK(side->dots == 2);
    }
}

TEST_CASE("derivation: places point to what was written") {
    const std::string text = "Ünder $E = m g\\ell$ and\n$$T = \\frac12 m v^2 = \\foo$$";
    const Written derivation = written(text);
    REQUIRE(derivation.statements.size() == 2);
    const WrittenStatement& first = derivation.statements[0];
    CHECK(text.substr(first.offset, first.length) == "E = m g\\ell");
    const Math& right = *first.sides[1];
    CHECK(text.substr(right.offset, right.length) == "m g\\ell");
    CHECK(text.substr(right.args[2]->offset, right.args[2]->length) == "\\ell");
    CHECK(derivation.line(first.offset) == 1);
    CHECK(derivation.column(first.offset) == 8);
    const WrittenStatement& second = derivation.statements[1];
    CHECK(text.substr(second.offset, second.length) == "\\foo");
    CHECK(derivation.line(second.offset) == 2);
    CHECK(derivation.column(second.offset) == 23);
    for (const Row& row : documents) try {
            for (const WrittenStatement& one : written(row.text).statements)
                for (const MathPtr& side : one.sides) check_places(*side, row.text);
        } catch (const SceneError&) {
        }
}

TEST_CASE("derivation: lines and columns are found at once in a long text") {
    std::string text = "$x=1$ ";
    for (int k = 0; k < 3000; ++k) text += k % 7 == 0 ? "ä\n" : "ö ";
    const Written derivation = written(text);
    int line = 1, column = 1;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80 && i % 97 == 0) {
            CHECK(derivation.line(i) == line);
            CHECK(derivation.column(i) == column);
        }
        if ((static_cast<unsigned char>(text[i]) & 0xC0) == 0x80) continue;
        line += text[i] == '\n';
        column = text[i] == '\n' ? 1 : column + 1;
    }
}

TEST_CASE("derivation: words, consequences, small angles, conditions and displays are told") {
    const Written derivation = written(
        "The kinetic energy is $T = a$.\n\nFor small angles we have $$\\sin\\theta \\approx \\theta$$ and "
        "therefore\n"
        "$$x = b \\implies y = c \\quad \\text{if } t > 0$$\n\nExactly, $z = d$.");
    REQUIRE(derivation.statements.size() == 5);
    const std::vector<WrittenStatement>& list = derivation.statements;
    CHECK(list[0].words == "The kinetic energy is");
    CHECK_FALSE(list[0].displayed);
    CHECK_FALSE(list[0].first_order);
    CHECK(list[1].first_order);
    CHECK(list[1].displayed);
    CHECK(list[2].consequence);
    CHECK(list[2].words == "and therefore");
    CHECK(list[3].consequence);
    CHECK(list[3].conditions.size() == 2);
    CHECK_FALSE(list[4].first_order);
    CHECK_FALSE(list[4].consequence);
}

TEST_CASE("derivation: is_derivation knows endings and LaTeX") {
    CHECK(is_derivation("x = 1", "a.tex"));
    CHECK(is_derivation("x = 1", "a.md"));
    CHECK(is_derivation("so $x = 1$", "-"));
    CHECK(is_derivation("\\begin{align} x &= 1 \\end{align}", "-"));
    CHECK_FALSE(is_derivation("m*x'' = -k*x  # a claim", "claims.txt"));
    CHECK_FALSE(is_derivation("it costs $5", "-"));
    for (const char* claims :
         {"m*x'' = -k*x\n\n# by hand, as the book has it\nx' = max(0, -x) + dot(vel(p), ex(N))  # the second one",
          "rest\nsin(theta) = 0\nmotoin", "constants E\nm*x'^2/2 + k*x^2/2 = E", "x = 1\nmotoin"})
        CHECK_FALSE(is_derivation(claims, "claims.txt"));
    for (const char* page :
         {"Kinetic energy: T = 1/2*m*x'^2", "T = ½ m ẋ²", "T = 1/2 m x'^2", "T = m*x'^2/2, V = k*x^2/2",
          "E = T + V = const", "The kinetic energy is T = m*x'^2/2."})
        CHECK(is_derivation(page, "page.txt"));
}

TEST_CASE("derivation: limits and encoding are told with their place") {
    CHECK(all(std::string(1024 * 1024 + 1, 'x')) ==
          "error: the derivation has 1048577 bytes; the limit is 1048576 (1 MiB)");
    CHECK(all("$x = 1$ \xE4") == "error: the byte 0xE4 is not UTF-8 here; save the file as UTF-8");
    const auto repeated = [](const std::string& what, int count) {
        std::string text;
        for (int k = 0; k < count; ++k) text += what;
        return text;
    };
    CHECK(all(repeated("$x=1$ ", 10001)) == "error: the derivation has more than 10000 statements");
    CHECK(display("x" + repeated("+x", 60000)) == "error: the derivation has more than 100000 tokens");
    CHECK(display(repeated("(", 101) + "x" + repeated(")", 101)) ==
          "error: the formula is nested more than 100 levels deep");
    CHECK(display(repeated("(", 99) + "x" + repeated(")", 99)) == "x");
    CHECK(display("a" + repeated("/a", 400)) == "error: the formula is nested more than 100 levels deep");
    try {
        written("a\nb $x = 1$ \xFF");
        FAIL("invalid UTF-8 was read");
    } catch (const SceneError& error) {
        CHECK(error.diagnostics.at(0).place == Place{2, 11});
    }
}

TEST_CASE("derivation: hostile text is refused in bounded time, and nothing is read or executed") {
    const auto repeated = [](const std::string& what, std::size_t bytes) {
        std::string text;
        while (text.size() < bytes) text += what;
        return text;
    };
    const std::string macros =
        "\\newcommand{\\a}{\\b\\b\\b\\b\\b\\b\\b\\b}\\newcommand{\\b}{\\c\\c\\c\\c\\c\\c\\c\\c}\\newcommand{\\c}{"
        "\\e\\e\\e\\e\\e\\e\\e\\e}"
        "\\newcommand{\\e}{xxxxxxxxxxxxxxxx}" +
        repeated("$\\a$ ", 100000);
    std::vector<std::string> texts = {macros, "\\newcommand{\\a}{\\a\\a}$$\\a = 1$$",
                                      "$\\csname x\\endcsname = 1$"};
    for (const std::string piece : {"{",
                                    "$",
                                    "$$",
                                    "(",
                                    "\\frac{",
                                    "\\frac{d}{d",
                                    "-",
                                    "\\dot",
                                    "x^",
                                    "x_",
                                    "\\begin{align}",
                                    "\\end{align}",
                                    "\\\\",
                                    "&",
                                    "=",
                                    "\\left(",
                                    "\\left.",
                                    "|x",
                                    "`",
                                    "(\\a ",
                                    "x =\n",
                                    "```\n",
                                    "[\n",
                                    "\\text{",
                                    "\\mathrm{\\theta ",
                                    "\\SI{",
                                    "\\qty{",
                                    "\\sum",
                                    "d/d",
                                    "\\delta",
                                    "'",
                                    "diff(",
                                    "\\(",
                                    "\\[",
                                    ".. math::\n",
                                    "x\xCC\x87",
                                    "\\sin",
                                    "a/",
                                    "\\newcommand{\\x}{",
                                    "\\begin{cases}a&b\\\\",
                                    "**",
                                    "\\phantom{",
                                    "$x\n\n",
                                    "\\[Theta]",
                                    "x = 1, "})
        for (const char* before : {"", "$$", "x = "}) texts.push_back(before + repeated(piece, 100000));
    for (const std::string& text : texts)
        for (const char* file : {"a.tex", "a.md"}) {
            CAPTURE(text.substr(0, 60));
            const std::clock_t begin = std::clock();
            all(text, file);
            CHECK(std::clock() - begin < 2 * CLOCKS_PER_SEC);
        }
    CHECK(all("\\input{/etc/passwd} $x=1$").starts_with("not: '\\input' is refused"));
    CHECK(all("$x = \\write18{ls}$").starts_with("not: '\\write' is refused"));
}

TEST_CASE("derivation: mutilated text is read or told, and never crashes") {
    const unsigned seed = 47;
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto below = [&](std::size_t n) {
        return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1));
    };
    std::vector<std::string> texts;
    for (const Row& row : latex_rows) texts.push_back("$$" + std::string(row.text) + "$$");
    for (const Row& row : plain_rows) texts.emplace_back(row.text);
    for (const Row& row : documents) texts.emplace_back(row.text);
    for (int round = 0; round < 6000; ++round) {
        std::string text = texts[below(texts.size())];
        for (std::size_t edits = 1 + below(4); edits > 0; --edits) {
            const std::string& other = texts[below(texts.size())];
            const std::size_t at = below(text.size());
            switch (below(4)) {
                case 0:
                    text.erase(at, 1 + below(6));
                    break;
                case 1:
                    text.insert(at, other.substr(below(other.size()), 1 + below(12)));
                    break;
                case 2:
                    text.insert(at, 1, "{}()[]$\\^_&=|'.,;:/*+-~%#<>\n`"[below(30)]);
                    break;
                default:
                    text += other;
            }
        }
        CAPTURE(text);
        try {
            for (const WrittenStatement& one : written(text, below(2) == 0 ? "a.tex" : "a.md").statements) {
                CHECK(one.offset + one.length <= text.size());
                CHECK(one.sides.empty() == !one.reason.empty());
                for (const MathPtr& side : one.sides) {
                    REQUIRE(side != nullptr);
                    check_places(*side, text);
                    CHECK_FALSE(latex(*side).empty());
                }
            }
        } catch (const SceneError&) {  // words alone, or half a character
        }
    }
}

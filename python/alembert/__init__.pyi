# SPDX-License-Identifier: GPL-2.0-or-later
from contextlib import AbstractContextManager
from os import PathLike
from typing import Any, Callable, Iterable, Literal, Mapping, Sequence, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

_Path = str | PathLike[str]
_Values = Mapping[str, float | str] | None
_Range = tuple[str, float, float] | tuple[str, float, float, int] | Sequence[Any]

class Error(RuntimeError): ...
class SceneError(Error):
    diagnostics: list[tuple[int, int, str]]
class ModelError(Error): ...
class IntegrationError(Error):
    time: float
    state: list[float]
class EnvironmentFailure(Error): ...
class SceneWarning(UserWarning): ...

class Figure:
    svg: str
    def __init__(self, svg: str) -> None: ...
    def save(self, path: _Path) -> None: ...

class Result:
    json: dict[str, Any]
    def __getattr__(self, name: str) -> Any: ...

_Verdict = Literal["proved", "refuted", "undecided", "vacuous"]

class _Likely(TypedDict):
    kind: str
    term: str

class _Assumption(TypedDict):
    kind: Literal["side", "branch", "parameter", "pose", "closed", "small", "stated"]
    text: str

class _Branch(TypedDict):
    where: str | None
    verdict: _Verdict
    counterexample: dict[str, str]

class _ClaimAlways(TypedDict):
    equation: str
    line: int
    at: str
    verdict: _Verdict
    method: Literal["proved", "sampled"]
    kinematic: bool
    counterexample: dict[str, str]
    residual: float | None
    difference: str
    likely: _Likely | None
    assumed: list[_Assumption]

class _Claim(_ClaimAlways, total=False):
    source: str
    failure_bound_log2: float
    residual_text: str
    nearest: str
    reason: str
    where: list[str]
    holds_where: list[str]
    other_branches: list[_Branch]

class Checked(Result):
    claims: list[_Claim]
    complete: bool
    missing_equations: list[str]
    degrees_of_freedom: int
    @property
    def verdicts(self) -> list[_Verdict]: ...
    def __bool__(self) -> bool: ...

_Status = Literal["right", "right_near", "right_up_to_constant", "right_up_to_derivative", "definition", "mistake",
                  "follows", "unfounded", "undecided", "not_understood", "not_about_scene"]

class _LineAlways(TypedDict):
    line: int
    column: int
    source: str
    claim: str
    status: _Status
    verdict: _Verdict | None
    method: Literal["proved", "sampled"] | None
    term: str
    likely: _Likely | None
    right: str
    follows_from: int | None
    reason: str
    counterexample: dict[str, str]

class _Line(_LineAlways, total=False):
    right_latex: str
    residual: float
    difference: str

class Marked(Result):
    file: str
    lines: list[_Line]
    first_mistake: int | None
    judged: int
    missing: list[str]
    complete: bool
    letters: dict[str, str]
    remarks: list[str]
    @property
    def statuses(self) -> list[_Status]: ...
    @property
    def html(self) -> str: ...
    def save(self, path: _Path) -> None: ...
    def __bool__(self) -> bool: ...

class Agreed(Result):
    formalisms: list[str]
    verdict: Literal["proved", "refuted", "undecided"]
    method: Literal["proved", "sampled"]
    points: int
    failure_bound_log2: float
    refused: dict[str, str]
    seconds: float

class _Constraint(TypedDict):
    name: str
    kind: Literal["holonomic", "nonholonomic"]
    rheonomic: bool
    integrable: bool | None
    integrable_alone: bool | None
    integral: str | None
    redundant: bool
    residual: list[float | None]
    notes: list[str]

class Audited(Result):
    constraints: list[_Constraint]
    rank: int
    degrees_of_freedom: int
    notes: list[str]

class Stability(Result):
    verdict: Literal["asymptotically stable", "stable", "unstable", "undecided"]
    theorem: str
    reason: str
    states: list[str]
    eigenvalues: list[tuple[float, float]]
    conditions: list[str]
    conditions_for: str
    coefficients: list[str]
    certain: bool
    assumed: list[_Assumed]

class _Assumed(TypedDict):
    kind: Literal["state", "numbers", "family"]
    text: str

class _EquilibriumAlways(TypedDict):
    coordinates: dict[str, float]
    rates: dict[str, float]
    moving: list[str]
    multipliers: dict[str, float]
    residual: float
    state: Literal["exact", "proved", "open", "in numbers"]
    isolated: bool
    stable: Literal["yes", "no", "undecided"]
    because: str
    assumed: list[_Assumed]
    eigenvalues: list[tuple[float, float]]

class _Family(TypedDict):
    dimension: int
    free: list[str]

class _Equilibrium(_EquilibriumAlways, total=False):
    exact: dict[str, str]
    where: list[str]
    family: _Family

class Equilibria(Result):
    equilibria: list[_Equilibrium]
    complete: bool
    method: Literal["closed form", "search"]
    formalism: str

class Linearized(Result): ...

class SINumber(float):
    unit: str

class Drawn(Result):
    @property
    def figure(self) -> Figure: ...
    @property
    def csv(self) -> str: ...

class Sources(Result):
    @property
    def sources(self) -> dict[str, str]: ...

class Equation:
    text: str
    latex: str
    def __init__(self, text: str, latex: str) -> None: ...
    def sympy(self) -> Any: ...

class Derivation(Result):
    @property
    def equations(self) -> list[Equation]: ...
    def page(self, format: str = ..., steps: bool = ...) -> str: ...

class Run(Result):
    @property
    def units(self) -> dict[str, str]: ...
    final: dict[str, Any]
    columns: list[str]
    table: NDArray[np.float64]
    failure: str | None
    @property
    def contacts(self) -> list[dict[str, Any]]: ...
    @property
    def t(self) -> NDArray[np.float64]: ...
    def __getitem__(self, column: str) -> NDArray[np.float64]: ...
    def __call__(self, t: ArrayLike) -> NDArray[np.float64]: ...
    def plot(self, *columns: str) -> Figure: ...
    def save(self, path: _Path) -> None: ...

class Swept(Result):
    columns: list[str]
    table: NDArray[np.float64]
    @property
    def statistics(self) -> dict[str, dict[str, float | None]]: ...
    def __getitem__(self, column: str) -> NDArray[np.float64]: ...

class System:
    dimension: int
    coordinates: list[str]
    speeds: list[str]
    def __init__(
        self, scene: Scene, by: str = ..., jacobian: bool = ..., functions: Iterable[str] = ...,
        frames: Iterable[str] = ...
    ) -> None: ...
    inputs: list[str]
    def rhs(self, t: ArrayLike, y: ArrayLike, inputs: ArrayLike | None = ...) -> NDArray[np.float64]: ...
    def jacobian(self, t: ArrayLike, y: ArrayLike, inputs: ArrayLike | None = ...) -> NDArray[np.float64]: ...
    def mass_matrix(self, t: ArrayLike, y: ArrayLike, inputs: ArrayLike | None = ...) -> NDArray[np.float64]: ...
    def energy(self, t: ArrayLike, y: ArrayLike, inputs: ArrayLike | None = ...) -> NDArray[np.float64]: ...
    def rhs_of_columns(self, t: ArrayLike, y: ArrayLike) -> NDArray[np.float64]: ...
    def __call__(self, t: ArrayLike, y: ArrayLike, inputs: ArrayLike | None = ...) -> NDArray[np.float64]: ...
    @property
    def parameters(self) -> dict[str, float]: ...
    def set(self, values: Mapping[str, float] | None = ..., /, **more: float) -> None: ...
    @property
    def source(self) -> str: ...

class RobotFunction:
    name: str
    shape: tuple[int, ...]
    operations: int
    def __call__(
        self, q: ArrayLike, v: ArrayLike | None = ..., a: ArrayLike | None = ..., *, t: ArrayLike = ...
    ) -> NDArray[np.float64]: ...

class Robot(System):
    functions: dict[str, RobotFunction]
    def __init__(
        self, scene: Scene, functions: Iterable[str], frames: Iterable[str] = ..., by: str = ...
    ) -> None: ...
    def __getattr__(self, name: str) -> RobotFunction: ...

class Scene:
    text: str
    name: str
    imported: Result
    def __init__(
        self, source: _Path | Mapping[str, Any] | None = ..., *, text: str | None = ..., name: str | None = ...
    ) -> None: ...
    @classmethod
    def from_robot(
        cls, path: _Path, *, loops: _Path | None = ..., floating: bool = ..., quaternion: bool = ...,
        drives: bool = ..., friction: bool = ..., stops: bool = ..., right_angles: bool = ...,
        strict: bool = ..., package: _Path | Sequence[_Path] = ..., allow_outside: bool = ...
    ) -> Scene: ...
    def derive(self, by: str = ..., *, reactions: bool = ..., at: _Values = ...) -> Derivation: ...
    def draw(self, at: _Values = ...) -> Figure: ...
    def check(self, claims: str | Any | Iterable[Any] | None = ..., *, by: str = ..., at: _Values = ...) -> Checked: ...
    def mark(
        self, derivation: str, *, letters: Mapping[str, str] | None = ..., by: str = ..., at: _Values = ...
    ) -> Marked: ...
    def audit(self, at: _Values = ...) -> Audited: ...
    def agree(self, at: _Values = ...) -> Agreed: ...
    def eval(
        self, at: _Values = ..., *, by: str = ..., reactions: bool = ..., matrices: bool = ...
    ) -> Result: ...
    def inverse(self, at: _Values = ..., *, by: str = ...) -> Result: ...
    def prove(
        self, at: _Values = ..., *, by: str = ..., duration: float | None = ..., sample: float | None = ...
    ) -> Result: ...
    def impact(self, at: _Values = ...) -> Result: ...
    def kinematics(
        self, of: Iterable[str] = ..., at: _Values = ..., *, steps: bool = ..., jacobian: bool = ...
    ) -> Result: ...
    def inertia(self, of: Iterable[str] = ..., about: str = ..., at: _Values = ...) -> Result: ...
    def identify(self, at: _Values = ...) -> Result: ...
    def initial_state(self, at: _Values = ...) -> NDArray[np.float64]: ...
    def equilibrium(self, at: _Values = ..., *, by: str = ..., starts: int = ...) -> Equilibria: ...
    def branches(self, over: _Range, at: _Values = ..., *, by: str = ...) -> Drawn: ...
    def linearize(
        self, at: _Values = ..., *, by: str = ..., affine: bool = ..., along: bool = ...,
        duration: float | None = ..., tolerance: float | None = ..., sample: float | None = ...
    ) -> Linearized: ...
    def stability(
        self, at: _Values = ..., *, by: str = ..., period: float = ..., lyapunov: str = ...
    ) -> Stability: ...
    def stability_chart(
        self, x: _Range, y: _Range, at: _Values = ..., *, by: str = ..., period: float = ...
    ) -> Drawn: ...
    def root_locus(self, over: _Range, at: _Values = ..., *, by: str = ..., period: float = ...) -> Drawn: ...
    def exponents(
        self, count: int = ..., at: _Values = ..., *, by: str = ..., duration: float = ...
    ) -> Drawn: ...
    def simulate(
        self, duration: float | None = ..., tolerance: float | None = ..., *, method: str = ...,
        step: float | None = ..., sample: float | None = ..., max_step: float | None = ..., budget: int = ...,
        estimate: bool = ..., reactions: bool = ..., by: str = ..., fast_math: bool = ..., poincare: str = ...,
        code: str = ..., sensitivity: Sequence[str] = ..., sensitivity_of: Sequence[str] = ...,
        sensitivity_rows: bool = ..., regularize: bool = ..., tuning: bool = ..., at: _Values = ...,
        input: Mapping[str, str | float | _Path] | None = ...
    ) -> Run: ...
    def sweep(
        self, values: Mapping[str, ArrayLike], duration: float | None = ..., tolerance: float | None = ..., *,
        grid: bool = ..., method: str = ..., step: float | None = ..., max_step: float | None = ...,
        budget: int = ..., by: str = ..., threads: int = ..., code: str = ..., fast_math: bool = ...,
        along: str | Sequence[str] = ..., reduce: str | Sequence[str | float] = ..., samples: int | None = ...,
        sampling: str = ..., seed: int = ..., path: _Path | None = ..., resume: bool = ..., tuning: bool = ...,
        at: _Values = ..., input: Mapping[str, str | float | _Path] | None = ...
    ) -> Swept: ...
    def bench(
        self, duration: float | None = ..., *, method: str = ..., max_step: float | None = ..., budget: int = ...,
        code: str = ..., run_seconds: float = ..., reference_seconds: float = ..., peers: bool = ..., by: str = ...,
        tuning: bool = ..., at: _Values = ..., input: Mapping[str, str | float | _Path] | None = ...
    ) -> Drawn: ...
    def system(self, by: str = ..., *, jacobian: bool = ..., at: _Values = ...) -> System: ...
    def robot(
        self, functions: Iterable[str] = ..., frames: Iterable[str] = ..., *, by: str = ...,
        at: _Values = ...
    ) -> Robot: ...
    def emit(
        self, folder: _Path | None = ..., *, language: str = ..., standalone: bool = ..., fold: bool = ...,
        jacobian: bool = ..., functions: Iterable[str] = ..., frames: Iterable[str] = ..., wrenches: Iterable[str] = ...,
        batch: bool = ..., casadi: bool = ..., by: str = ..., name: str = ..., at: _Values = ...
    ) -> Sources: ...
    def fmu(self, path: _Path, *, fmi: int = ..., by: str = ..., at: _Values = ...) -> Result: ...
    def report(
        self, path: _Path, *, duration: float | None = ..., budget: int = ..., motion: bool = ..., poincare: str = ...,
        bench: bool = ..., by: str = ..., at: _Values = ...,
        input: Mapping[str, str | float | _Path] | None = ...
    ) -> None: ...
    def live(
        self, *, duration: float | None = ..., budget: int = ..., height: int = ..., by: str = ..., at: _Values = ...
    ) -> Live: ...

class Live(Result):
    html: str
    height: int
    def __init__(self, page: str, name: str, height: int) -> None: ...
    def widget(self) -> Any: ...

def progress(told: Callable[[str, float], object]) -> AbstractContextManager[None]: ...
def to_sympy(text: str, functions: Iterable[str] = ...) -> Any: ...
def from_sympy(value: Any) -> str: ...

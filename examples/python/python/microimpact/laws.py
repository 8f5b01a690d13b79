"""Laws of contact."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy.typing as npt

from .arrays import ByValue

DAMPINGS = ("none", "hysteretic", "viscoelastic", "constant")


@dataclass(frozen=True, kw_only=True, eq=False)
class Contact(ByValue):
    """What all laws have: the elastic stiffness, and one damping of the materials.

    Damping is hysteretic by `zeta_h`, or named by `damping` with its `damping_value`: `zeta_h` of "hysteretic", the relaxation
    time of "viscoelastic" in s, or the restitution that "constant" damping leaves without adhesion.
    """

    stiffness: npt.ArrayLike
    """Hertz stiffness K, Pa, 1 to 1e16."""
    zeta_h: npt.ArrayLike | None = None
    """Hysteretic damping zeta_H of the materials, 0 to 1e9."""
    damping: str | None = None
    """none, hysteretic, viscoelastic or constant."""
    damping_value: npt.ArrayLike | None = None
    """The number of a damping that is named."""
    external_force: npt.ArrayLike = 0.0
    """Constant external force, N, positive out of the surface."""

    law: ClassVar[str] = ""
    end_rules: ClassVar[tuple[str, ...]] = ()

    def __post_init__(self) -> None:
        if not self.law:
            raise TypeError("Contact has no law of its own; use Hertz, Ring, Dmt or Jkr")
        if self.damping is not None and self.damping not in DAMPINGS:
            raise ValueError(f'damping: "{self.damping}" is refused: it must be one of {", ".join(DAMPINGS)}')
        if self.damping is not None and self.zeta_h is not None:
            raise ValueError("damping: given twice, as zeta_h and damping; give one of them")
        if self.damping in (None, "none") and self.damping_value is not None:
            raise ValueError('damping_value: there is no damping of that value; name it, as damping="viscoelastic"')
        if self.damping not in (None, "none") and self.damping_value is None:
            raise ValueError(f"damping_value: missing; {self.damping} damping needs it")
        if self._end_rule() not in self.end_rules:
            raise ValueError(f'end_rule: "{self._end_rule()}" is refused: it must be {" or ".join(self.end_rules)}')

    def _end_rule(self) -> str:
        return self.end_rules[0]

    def words(self) -> tuple[str, str, str]:
        """Law, end rule and damping."""
        damping = self.damping or ("none" if self.zeta_h is None else "hysteretic")
        return self.law, self._end_rule(), damping

    def numbers(self) -> dict[str, npt.ArrayLike | None]:
        """The numbers by the names of their arguments."""
        named = self.damping == "hysteretic"
        return {
            "stiffness": self.stiffness,
            "zeta_h": self.damping_value if named else self.zeta_h,
            "damping_value": None if named else self.damping_value,
            "external_force": self.external_force,
        }


@dataclass(frozen=True, kw_only=True, eq=False)
class Hertz(Contact):
    """Hertz's contact, without adhesion."""

    end_rule: str = "no-indentation"
    """Where contact ends: no-indentation, or no-force, where damping cancels the elastic force."""

    law: ClassVar[str] = "hertz"
    end_rules: ClassVar[tuple[str, ...]] = ("no-indentation", "no-force")

    def _end_rule(self) -> str:
        return self.end_rule


@dataclass(frozen=True, kw_only=True, eq=False)
class Ring(Contact):
    """Hertz's contact with the paper's ring of adhesion, whose damping acts on rebound."""

    adhesion: npt.ArrayLike
    """Strength f0 of the ring, N/m, 0 to 1e9."""
    zeta_a: npt.ArrayLike = 0.0
    """Damping zeta_A of the ring, 0 to 1e9."""

    law: ClassVar[str] = "ring"
    end_rules: ClassVar[tuple[str, ...]] = ("no-indentation",)

    def numbers(self) -> dict[str, npt.ArrayLike | None]:
        """The numbers by the names of their arguments."""
        return {**super().numbers(), "adhesion": self.adhesion, "zeta_a": self.zeta_a}


@dataclass(frozen=True, kw_only=True, eq=False)
class Dmt(Contact):
    """Hertz's contact with the adhesion of Derjaguin, Muller and Toporov."""

    work_of_adhesion: npt.ArrayLike
    """Work of adhesion per area, J/m^2, 0 to 1e6: twice the surface energy of equal materials."""

    law: ClassVar[str] = "dmt"
    end_rules: ClassVar[tuple[str, ...]] = ("no-indentation",)

    def numbers(self) -> dict[str, npt.ArrayLike | None]:
        """The numbers by the names of their arguments."""
        return {**super().numbers(), "work_of_adhesion": self.work_of_adhesion}


@dataclass(frozen=True, kw_only=True, eq=False)
class Jkr(Contact):
    """The contact of Johnson, Kendall and Roberts. It takes no external force."""

    work_of_adhesion: npt.ArrayLike
    """Work of adhesion per area, J/m^2, 0 to 1e6: twice the surface energy of equal materials."""
    end_rule: str = "snap-off"
    """Where contact ends: snap-off, or pull-off, at the pull-off force."""

    law: ClassVar[str] = "jkr"
    end_rules: ClassVar[tuple[str, ...]] = ("snap-off", "pull-off")

    def _end_rule(self) -> str:
        return self.end_rule

    def numbers(self) -> dict[str, npt.ArrayLike | None]:
        """The numbers by the names of their arguments."""
        return {**super().numbers(), "work_of_adhesion": self.work_of_adhesion}

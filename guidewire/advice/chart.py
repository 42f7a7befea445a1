"""Chart of the settings tried on a scene: error against cost."""

from __future__ import annotations

import math

from matplotlib.figure import Figure

from guidewire.advice.plan import Advice, Tried, AdviceRequest
from guidewire.figures.style import add_caption, new_figure, styled
from guidewire.figures.wording import percent


@styled
def draw_advice(name: str, wish: AdviceRequest, advice: Advice) -> Figure:
    """Error over work, in that of the file as it is; what was timed is filled, what is taken has a ring."""
    figure = new_figure(8.0, 5.0)
    axes = figure.add_subplot()
    shown = [one for one in advice.searched if math.isfinite(one.error) and one.error > 0.0]
    counts = sorted({int(one.parameters["numberRodElements"]) for one in shown})
    for k, n in enumerate(counts):
        own = sorted((one for one in shown if one.parameters["numberRodElements"] == n), key=lambda one: one.work)
        axes.plot([_cost(one, advice) for one in own], [one.error for one in own], "o-", color=f"C{k}", linewidth=0.8,
                  fillstyle="none", label=f"n = {n}")
    front: list[Tried] = []
    for one in sorted(shown, key=lambda one: (one.work, one.error)):
        if not front or one.error < front[-1].error:
            front.append(one)
    if front:
        axes.plot([_cost(one, advice) for one in front], [one.error for one in front], color="0.8", linewidth=6,
                  zorder=0, label="not beaten in both")
    if math.isfinite(advice.scene.error) and advice.scene.error > 0.0:
        axes.plot(1.0, advice.scene.error, "k*", markersize=12, label="the file as it is")
    if advice.taken is not None and advice.taken.error > 0.0:
        axes.plot(_cost(advice.taken, advice), advice.taken.error, "o", color="C3", markersize=15, fillstyle="none",
                  markeredgewidth=2.0, label="taken")
    if wish.error is not None:
        axes.axhline(wish.error, color="0.3", linestyle="--", linewidth=1.0, label="asked")
    if advice.reference_error > 0.0 and math.isfinite(advice.reference_error):
        axes.axhspan(0.0, advice.reference_error, color="C1", alpha=0.15,
                     label="below the uncertainty of the reference")
    levels = [one.error for one in shown] + [level for level in (wish.error, advice.reference_error)
                                             if level and math.isfinite(level)]
    if levels:
        axes.set_ylim(0.5 * min(levels), 2.0 * max(levels))
    axes.set(xscale="log", yscale="log", xlabel="work relative to that of the file (1)",
             ylabel=f"error of {wish.quantity.said} (1)")
    axes.legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    lost = len(advice.searched) - sum(math.isfinite(one.error) for one in advice.searched)
    add_caption(figure, (
        f"{name}: error of {wish.quantity.said} over work of {len(advice.searched)} settings, one point each, "
        f"{lost} of them failed and not shown. Work is counted (iterations, factorisations) and is the same on every "
        f"machine. The reference is {advice.reference.trial.name.removeprefix('reference, ')}, known to "
        f"{percent(advice.reference_error)}."))
    return figure


def _cost(one: Tried, advice: Advice) -> float:
    return one.work / advice.scene.work

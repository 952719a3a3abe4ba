"""What the comparison of two records comes to, in words."""

from rich.console import Console
from rich.markup import escape

from raysteps.commands.inspect.pair import Difference
from raysteps.commands.inspect.values import Record
from raysteps.common.text import count
from raysteps.kit.manifest import Step


def step_of(steps: list[Step], function: str) -> Step | None:
    """The step whose function it is."""
    return next((step for step in steps if function in step.functions), None)


def cost_words(mine: Record, reference: Record) -> str:
    """What the pixel cost both; nothing where it is the same."""
    if mine["counts"] == reference["counts"]:
        return ""
    told = [
        f"{count(record['counts']['box_tests'], 'box test')} and "
        f"{count(record['counts']['surface_tests'], 'surface test')}"
        for record in (mine, reference)
    ]
    return f"Cost: yours {told[0]}, the reference {told[1]}."


def print_verdict(
    console: Console, steps: list[Step], mine: Record, reference: Record, parting: Difference | None
) -> None:
    """The first difference and the function that it points to."""
    cost = cost_words(mine, reference)
    if parting is None:
        console.print("[green]No difference[/green]: both come to the same colour in the same way.")
    else:
        console.print(f"[bold red]First difference[/bold red]: {escape(parting.words)}.", highlight=False)
        if parting.why:
            console.print(f"  {escape(parting.why[:1].upper() + parting.why[1:])}.", highlight=False)
        step = step_of(steps, parting.function)
        if step is not None:
            place = f"[bold]{escape(parting.function)}[/bold] in steps/{escape(step.path.as_posix())}"
            console.print(f"  Look at {place} (step {step.number}).", highlight=False)
    if cost:
        console.print(cost, highlight=False, style="dim")

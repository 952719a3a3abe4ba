"""What the keys do."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from raysteps.commands.course.hints import Hints, no_other
from raysteps.commands.course.listing import print_list
from raysteps.commands.course.reset import loss, own_file, print_done, print_loss, put_back
from raysteps.commands.course.standing import next_of, shown, standings
from raysteps.commands.watch.inspecting import command_of_worst, run_inspect
from raysteps.commands.watch.keys import NoKeyboard
from raysteps.common.errors import RaystepsError
from raysteps.reports.commands import typed

if TYPE_CHECKING:
    from raysteps.commands.watch.session import Session


class Actions:
    """One method for each key. A question turns the next key into its answer."""

    def __init__(self, session: "Session") -> None:
        self._session = session
        self._question: Callable[[], None] | None = None
        self._keys: dict[str, Callable[[], None]] = {
            "h": self._hint,
            "n": self._next,
            "l": self._list,
            "i": self._inspect,
            "c": self._check,
            "r": self._reset,
            " ": lambda: session.look("once more"),
            "?": session.showing.help,
            "q": self._quit,
        }

    def press(self, letter: str) -> None:
        """A key that means nothing does nothing. What goes wrong is told, and the loop goes on."""
        question, self._question = self._question, None
        try:
            if question is not None:
                if letter.lower() == "y":
                    question()
                else:
                    self._session.showing.line("Nothing was changed.")
            elif letter in self._keys:
                self._keys[letter]()
        except (RaystepsError, OSError) as error:
            self._session.showing.line(str(error), "red")

    def remind(self) -> None:
        """Of the keys, where there are any."""
        if not isinstance(self._session.keyboard, NoKeyboard):
            self._session.showing.keys()

    def _quit(self) -> None:
        self._session.over = True

    def _hint(self) -> None:
        session, step = self._session, self._session.view.step
        hint = Hints(session.project).following(step)
        if hint is None:
            for line in no_other(step).splitlines():
                session.showing.line(line)
            return
        session.showing.line(f"hint {hint.level} of {hint.of}", "bold")
        for line in hint.text.splitlines():
            session.showing.line(f"  {line}")
        session.showing.dim(hint.left)
        session.view.hints = [other for other in session.view.hints if other.level != hint.level] + [hint]
        session.show()

    def _next(self) -> None:
        session = self._session
        step = next_of(standings(session.project), after=session.view.step)
        if step is None:
            session.showing.line("There is no other step that is not done.")
        else:
            session.go_to(step)

    def _list(self) -> None:
        project = self._session.project
        print_list(project, self._session.showing.console, standings(project), self._session.view.step)

    def _check(self) -> None:
        session = self._session
        if session.view.phase == "checking":
            session.showing.dim("it is being checked already")
        elif session.view.phase == "looking":
            session.showing.dim("it will be checked as soon as it is built")
            session.check_after_look = True
        else:
            session.check()

    def _inspect(self) -> None:
        session = self._session
        words = command_of_worst(session.view)
        if words is None:
            session.showing.line("No picture is wrong (or there is none yet): nothing to look into.")
        else:
            session.showing.command(typed(words), "bold")
            with session.keyboard.lent():
                run_inspect(session.project, words)

    def _reset(self) -> None:
        session, step = self._session, self._session.view.step
        name = shown(session.project, step, step.file)
        lost = loss(session.project, step)
        if lost is None and own_file(session.project, step).is_file():
            session.showing.line(f"{name} is the stub already.")
            return

        def put() -> None:
            print_done(session.showing.console, name, put_back(session.project, step))

        if lost is None:
            put()
            return
        print_loss(session.showing.console, lost, name)
        session.showing.line("Put the stub back? Press y; any other key leaves it as it is.", "bold")
        self._question = put

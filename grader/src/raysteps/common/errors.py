"""What can go wrong, by exit code."""


class RaystepsError(Exception):
    """An error with a message for the person at the keyboard."""

    exit_code = 2


class UsageError(RaystepsError):
    """The command or one of its inputs makes no sense."""


class StudentBuildError(RaystepsError):
    """The student's own code does not build."""

    exit_code = 3


class GraderFault(RaystepsError):
    """The kit itself failed; never a student's zero."""

    exit_code = 4

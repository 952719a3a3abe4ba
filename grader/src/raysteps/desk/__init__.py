"""Where people read submissions of a class, comment on them and change points."""

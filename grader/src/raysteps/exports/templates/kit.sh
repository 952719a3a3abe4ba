raysteps() {
    if [ -n "${RAYSTEPS_VENV:-}" ]; then # a Python environment that is there already
        PYTHONPATH=$kit/grader/src "$RAYSTEPS_VENV/bin/python" -P -m raysteps "$@"
    else
        "$kit/raysteps" "$@"
    fi
}

"""What a page needs for `<compare-pictures>`; the macro `compare` in templates/compare.html.j2 writes the element."""

COMPARE_STYLES = ("compare",)
COMPARE_SCRIPTS = (
    "copy",
    "compare-heat",
    "compare-pixels",
    "compare-camera",
    "compare-paint",
    "compare-views",
    "compare-controls",
    "compare-words",
    "compare-marks",
    "compare-pointer",
    "compare-keyboard",
    "compare-desk",
    "compare",
)

"""The grader of Raysteps: builds, renders, checks and grades the steps."""

# The version of the whole kit: CMake, the package, reports and releases read it here.
__version__ = "0.2.0"

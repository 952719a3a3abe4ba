"""The C++ side: how the kit and a student's steps are compiled and linked."""

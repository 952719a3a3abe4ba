"""The grader of Raysteps: builds, renders, checks and grades the nine steps."""

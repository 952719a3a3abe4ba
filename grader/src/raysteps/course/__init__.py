"""The course as it stands in the repository: steps, stubs, known mistakes, settings of a term."""

"""The figures of the handouts: diagrams, pictures and plots, all made again by one command."""

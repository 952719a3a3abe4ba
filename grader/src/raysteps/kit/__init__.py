"""The kit in the repository: steps, stubs, scenes, builds."""

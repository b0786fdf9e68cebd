"""From a scene to its files: plan, build, report, read-back, convergence."""

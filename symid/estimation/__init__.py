"""Parameters by simulation and prediction: output-error and prediction-error fits, free runs, errors."""

"""Outputs predicted sample by sample: the predictor, its Kalman filter, its accuracy, and when it runs away."""

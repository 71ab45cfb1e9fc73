"""How certain the identified parameters are: sensitivities, covariance, and which combinations are determined."""

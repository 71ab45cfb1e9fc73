"""Parameters by simulation and prediction: output-error and prediction-error fits, free runs, errors.

Rooms, each on top of those before it: `sensors`, `signals`, `predicting`, `fitting`; and beside them what was measured
before it was filtered, what inputs do between their samples, free runs, predictions, and unknown bodies.
"""

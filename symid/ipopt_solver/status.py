"""Every status of Ipopt as a name and a sentence with a next step (IpReturnCodes_inc.h)."""

SOLVED = (0, 1)
STOPPED, WALL_TIME = 5, -5
STOPPED_BY_LIMIT = (-1, -4, WALL_TIME, STOPPED)

STATUS: dict[int, tuple[str, str]] = {
    0: ("Solve_Succeeded", "A locally optimal point was found. Try other starts if a better one may exist."),
    1: ("Solved_To_Acceptable_Level",
        "A point within the looser acceptable tolerance was found, not within the asked one. "
        "Usable; improve the scales or the start if it matters."),
    2: ("Infeasible_Problem_Detected",
        "The constraints contradict each other near this point. Look at the worst constraint below, "
        "widen bounds, or start elsewhere."),
    3: ("Search_Direction_Becomes_Too_Small",
        "The steps became too small to improve anything. Usually the derivatives are wrong or the "
        "scales far off: run check_derivatives."),
    4: ("Diverging_Iterates",
        "The variables run off to infinity: the objective seems to have no minimum. Give finite bounds "
        "to the parameters."),
    5: ("User_Requested_Stop", "The solve was stopped from outside. In Python, warm_start goes on from here."),
    6: ("Feasible_Point_Found",
        "A point that satisfies the square system of equations was found; there was nothing to minimise."),
    -1: ("Maximum_Iterations_Exceeded",
         "The iterations ran out. Allow more of them, or start nearer to the solution; in Python, "
         "warm_start goes on from here."),
    -2: ("Restoration_Failed",
         "No feasible point could be reached from here. Look at the worst constraint below; start "
         "elsewhere or check its bounds."),
    -3: ("Error_In_Step_Computation",
         "The linear system could not be solved even when regularised. Look for parameters that "
         "nothing depends on, dependent equations and far-off scales."),
    -4: ("Maximum_CpuTime_Exceeded", "The time ran out. Allow more of it, or try another start."),
    -5: ("Maximum_WallTime_Exceeded", "The time ran out. Allow more of it, or try another start."),
    -10: ("Not_Enough_Degrees_Of_Freedom",
          "There are more equations than free variables. Free some variables or drop equations."),
    -11: ("Invalid_Problem_Definition",
          "The problem is malformed; this is a mistake in symid or in a hand-made NonlinearProgram. "
          "Check its sizes and bounds."),
    -12: ("Invalid_Option", "Ipopt refused an option. Check the spelling and the value of `options`."),
    -13: ("Invalid_Number_Detected",
          "A function or derivative gave NaN or infinity. Start elsewhere or tighten the bounds."),
    -100: ("Unrecoverable_Exception", "Ipopt failed inside. Try another start or hessian='limited-memory'."),
    -101: ("NonIpopt_Exception_Thrown", "Something below Ipopt failed. Try another start; report it if it stays."),
    -102: ("Insufficient_Memory", "The memory ran out. Take fewer episodes or a shorter window."),
    -199: ("Internal_Error", "Ipopt met a mistake of its own. Report it with the problem that shows it."),
}  # fmt: skip


def explain(status: int) -> tuple[str, str]:
    """Return name and sentence of an Ipopt status, also of one that is not in the list."""
    unknown = (f"Unknown_Status_{status}", "This Ipopt is newer than symid: see its release notes.")
    return STATUS.get(status, unknown)

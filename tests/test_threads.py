"""Independent work in threads: the same results in the same order, never more threads than were asked for."""

import threading

import pytest
from threadpoolctl import threadpool_info, threadpool_limits

from symid.threads import in_threads, one_blas_thread, threads_of


def test_results_come_in_the_order_of_the_items_for_any_number_of_threads():
    for count in (1, 2, 3):
        with threads_of(count):
            assert in_threads(lambda k: k * k, range(20)) == [k * k for k in range(20)]


def test_two_threads_work_at_once_and_one_does_not():
    both = threading.Barrier(2, timeout=10)
    with threads_of(2):
        in_threads(lambda _: both.wait(), range(2))  # neither passes without the other
    names = in_threads(lambda _: threading.current_thread().name, range(3))
    assert set(names) == {threading.current_thread().name}


def test_work_within_a_thread_starts_no_threads_of_its_own():
    def inner(_):
        outer = threading.current_thread()
        return all(t is outer for t in in_threads(lambda _: threading.current_thread(), range(3)))

    with threads_of(2):
        assert in_threads(inner, range(4)) == [True] * 4
        assert len(in_threads(lambda k: k, range(2))) == 2  # and what comes after is in threads again


def test_what_one_item_raises_is_raised():
    with threads_of(2), pytest.raises(ZeroDivisionError):
        in_threads(lambda k: 1 / k, [1, 0, 2])
    with threads_of(2), pytest.raises(ValueError, match="later"):
        raise ValueError("later")
    assert in_threads(lambda _: threading.current_thread(), [0]) == [threading.current_thread()]


def blas_threads() -> set[int]:
    return {library["num_threads"] for library in threadpool_info() if library["user_api"] == "blas"}


def test_a_call_and_each_step_of_a_generator_keep_to_one_blas_thread():
    @one_blas_thread
    def steps():
        yield blas_threads()
        yield blas_threads()

    with threadpool_limits(limits=2, user_api="blas"):
        assert one_blas_thread(blas_threads)() == {1}
        for within in steps():
            assert within == {1}
            assert blas_threads() == {2}  # the caller's own work between the steps is not held back

"""What is done beside the pictures of a step, where a machine has a processor for it."""

import threading
from contextlib import ExitStack

import pytest

from raysteps.grading.step import SpareProcessors


def test_without_a_spare_processor_the_work_comes_first() -> None:
    done: list[str] = []
    with ExitStack() as ends, SpareProcessors(0, ends).beside(lambda: done.append("work")):
        done.append("block")
    assert done == ["work", "block"]


def test_work_and_block_go_on_at_the_same_time() -> None:
    of_the_work, of_the_block = threading.Event(), threading.Event()

    def work() -> None:
        of_the_work.set()
        of_the_block.wait()

    with ExitStack() as ends, SpareProcessors(1, ends).beside(work):
        of_the_work.wait()  # each waits for the other: one after the other, they would never end
        of_the_block.set()


def test_work_that_no_processor_came_to_is_done_all_the_same() -> None:
    busy, free, done = threading.Event(), threading.Event(), []
    with ExitStack() as ends:
        spare = SpareProcessors(1, ends)
        spare.prepare(busy.set)
        spare.prepare(free.wait)
        busy.wait()
        with spare.beside(lambda: done.append(threading.current_thread())):
            assert done == []
        assert done == [threading.current_thread()]
        free.set()


@pytest.mark.parametrize("processors", [0, 1])
def test_a_fault_of_the_work_is_a_fault_of_the_whole(processors: int) -> None:
    def work() -> None:
        raise ValueError("no picture")

    with (
        ExitStack() as ends,
        pytest.raises(ValueError, match="no picture"),
        SpareProcessors(processors, ends).beside(work),
    ):
        pass


def test_a_block_that_fails_leaves_nothing_at_work() -> None:
    begun, failed, done = threading.Event(), threading.Event(), threading.Event()

    def work() -> None:
        begun.set()
        failed.wait()
        done.set()

    with ExitStack() as ends:
        spare = SpareProcessors(1, ends)

        def fail() -> None:
            begun.wait()
            failed.set()
            raise ValueError("of the block")

        with pytest.raises(ValueError, match="of the block"), spare.beside(work):
            fail()
        assert done.is_set()

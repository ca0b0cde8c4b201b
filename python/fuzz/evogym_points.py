"""The entry points of `nbc.evogym` for `entry_points.py`, with values of wrong types, shapes and sizes.

Each call makes an object, uses it with random arguments, and then uses it as it should be used: a call that was refused
must have left it whole.
"""

from __future__ import annotations

from typing import Any, Callable, List, Tuple

import numpy as np

from nbc import evogym

BODY = np.array([[3, 3], [4, 1]])
TASKS = ("Walker-v0", "Catcher-v0", "BidirectionalWalker-v0", "UpStepper-v0", "AreaMaximizer-v0")


def world() -> evogym.EvoWorld:
    """A robot, a package and the ground."""
    made = evogym.EvoWorld()
    made.add_from_array("ground", np.full((1, 8), 5), 0, 0)
    made.add_from_array("robot", BODY, 1, 1)
    made.add_from_array("box", [[2]], 5, 1)
    return made


def evogym_points(make: Any) -> List[Tuple[str, Callable[[], Any]]]:
    """The entry points with random arguments."""
    some, options, pick = make.some, make.options, make.random.choice
    name = lambda: some("robot", "box", "ground", "robt")
    number = lambda: pick([make.number(), make.number(), some(0, 1), 4096, -5])
    targets = lambda: pick([np.full(3, 1.2), np.full((1, 3), 1.2), np.ones(6), make.any()])

    def attempt(calls: List[Callable[[], Any]], whole: Callable[[], Any]) -> Any:
        """Some of the calls, in any order, then the one that must go well whatever happened to them."""
        try:
            for call in make.random.sample(calls, min(3, len(calls))):
                call()
        finally:
            whole()

    def worlds() -> None:
        made = world()

        def use() -> None:
            assert made.copy().grid.ndim == 2 and made.objects.keys() >= {"ground"}
            evogym.EvoSim(world()).step()

        attempt([
            lambda: made.add_from_array(name(), make.array(), number(), number(), some(None, make.array())),
            lambda: made.add_from_array(some("b"), make.any(), some(3), some(3)),
            lambda: made.add_from_json(make.text()),
            lambda: made.move_object(name(), number(), number()),
            lambda: made.translate_object(name(), number(), number()),
            lambda: made.add_object(make.any()),
            lambda: evogym.EvoSim(made).step(),
            lambda: evogym.WorldObject.from_array(make.text(), make.array(), make.array()),
            lambda: evogym.EvoWorld.of_task(make.text()),
            lambda: evogym.EvoWorld.from_json(make.text()),
        ], use)

    def sims() -> None:
        sim = evogym.EvoSim(world())
        sim.step()

        def use() -> None:
            sim.set_action("robot", np.ones(3))
            assert sim.step() is False and np.isfinite(sim.pos_at_time(sim.get_time())).all()

        attempt([
            lambda: sim.set_action(name(), targets()),
            lambda: sim.revert(number()),
            lambda: sim.pos_at_time(number()),
            lambda: sim.vel_at_time(number()),
            lambda: sim.object_pos_at_time(number(), name()),
            lambda: sim.object_vel_at_time(number(), make.text()),
            lambda: sim.object_orientation_at_time(number(), name()),
            lambda: sim.get_actuator_indices(name()),
            lambda: sim.get_dim_action_space(make.any()),
            lambda: evogym.EvoSim(make.any()),
        ], use)

    def scenes() -> None:
        all_of = evogym.Scenes([world(), world()])
        numbers = lambda: pick([[0, 1], [number()], [number(), number()], make.any()])

        def use() -> None:
            all_of.step(np.ones(6))
            assert all_of.clock.min() >= 1 and np.isfinite(all_of.points([0, 1], "robot")[0]).all()

        attempt([
            lambda: all_of.step(targets(), number()),
            lambda: all_of.step(np.ones(6), number()) if make.random.random() < 0.1 else None,
            lambda: all_of.reset(number()),
            lambda: all_of.points(numbers(), name()),
            lambda: all_of.centers(numbers(), name()),
            lambda: all_of.shapes(numbers(), name()),
            lambda: all_of.extents(numbers(), name()),
            lambda: all_of.turns(numbers(), name()),
            lambda: all_of.surface(numbers(), name(), some(["ground"], ["box", "robot"], []), number(), make.number(),
                                   make.any()),
            lambda: all_of.voxels(number(), name()),
            lambda: all_of.actuators(number(), make.any()),
            lambda: evogym.draw_world(all_of, number(), world(), **options(
                width=lambda: some(64), height=lambda: some(32), view=make.number, follow=make.text)),
            lambda: evogym.Scenes(make.any()),
        ], use)

    def viewers() -> None:
        sim = evogym.EvoSim(world())
        viewer = evogym.EvoViewer(sim, resolution=(20, 10))

        def use() -> None:
            evogym.EvoViewer(sim, resolution=(20, 10)).render("img")

        attempt([
            lambda: viewer.set_pos(pick([(number(), number()), make.any()])),
            lambda: viewer.set_view_size(pick([(number(), number()), make.any()])),
            lambda: viewer.set_resolution(make.any()),
            lambda: viewer.set_target_rps(make.number()),
            lambda: viewer.track_objects(name(), make.text()),
            lambda: viewer.set_tracking_settings(**{some("lock_x", "padding", "scale", "lock") : make.any()}),
            lambda: viewer.render(some("img", "rgb_array"), make.any(), make.any()),
        ], use)

    points = [
        ("EvoWorld", worlds), ("EvoSim", sims), ("Scenes", scenes), ("EvoViewer", viewers),
        ("sample_robot", lambda: evogym.sample_robot(some((2, 2), (0, 5), (number(), number())), some(None))),
        ("is_connected", lambda: evogym.is_connected(make.array())),
        ("has_actuator", lambda: evogym.has_actuator(make.any())),
        ("get_full_connectivity", lambda: evogym.get_full_connectivity(make.array())),
        ("hashable", lambda: evogym.hashable(make.array())),
        ("draw", lambda: evogym.draw(make.any())),
        ("get_uniform", lambda: evogym.get_uniform(some(3))),
        ("save_gif", lambda: evogym.save_gif(make.text(), some([np.zeros((2, 2, 3), np.uint8)]), make.number())),
    ]
    try:
        from nbc.evogym.envs import EvoGymBase, TaskEnv, TaskVectorEnv, make_many
    except ImportError:
        return points

    def bases() -> None:
        base = EvoGymBase(world())

        def use() -> None:
            assert base.step({"robot": np.ones(3)}) is False

        attempt([
            lambda: base.step(pick([{name(): targets()}, make.any()])),
            lambda: base.get_floor_obs(name(), some(["ground"], [name()]), number(), make.number()),
            lambda: base.get_ceil_obs(name(), some(["ground"]), number()),
            lambda: base.get_pos_com_obs(name()),
            lambda: base.get_vel_com_obs(make.any()),
            lambda: base.get_relative_pos_obs(name()),
            lambda: base.get_ort_obs(make.any()),
            lambda: EvoGymBase(world(), some("img"), make.any()),
        ], use)

    def tasks() -> None:
        env = TaskEnv(pick(TASKS), BODY)
        env.reset(seed=1)

        def use() -> None:
            assert np.isfinite(env.step(np.ones(3))[0]).all()

        attempt([
            lambda: env.step(targets()),
            lambda: env.reset(seed=make.number(), options=some(None, {"goals": make.any()})),
            lambda: env.reset(options=pick([{"goals": [number(), number()]}, make.any()])),
            lambda: env.sim.set_action("robot", targets()),
            lambda: env.render(),
            lambda: TaskEnv(make.text(), BODY),
            lambda: TaskEnv(pick(TASKS), make.body(), make.any(), make.text(), make.any()),
        ], use)

    def vectors() -> None:
        many = TaskVectorEnv(pick(TASKS), [BODY, BODY])
        many.reset(seed=1)

        def use() -> None:
            assert np.isfinite(many.step(np.ones((2, 3)))[0]).all()

        attempt([
            lambda: many.step(pick([targets(), np.ones((2, 3)), np.ones((3, 2))])),
            lambda: many.reset(seed=some(1, [1, None], [1])),
            lambda: many.reset(options=some({"goals": make.any()}, {"goals": [None, [number(), number()]]})),
            lambda: many.reset(options={"reset_mask": some(np.array([True, False]), make.array())}),
            lambda: TaskVectorEnv(pick(TASKS), make.any(), **options(
                autoreset_mode=lambda: some("NextStep"), render_mode=lambda: some("img"), render_options=make.any,
                max_episode_steps=make.number, connections=make.any)),
            lambda: make_many(pick(TASKS), some(2, 5 * 10**7), BODY),
        ], use)

    return [*points, ("EvoGymBase", bases), ("TaskEnv", tasks), ("TaskVectorEnv", vectors)]

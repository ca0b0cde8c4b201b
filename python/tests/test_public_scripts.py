"""What public scripts do with Evolution Gym, written anew with changed imports. docs/evolution-gym.md lists them; each
test has the repository and file of the script that it follows."""

from __future__ import annotations

import json
import math
import random
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

gym = pytest.importorskip("gymnasium")
import nbc.evogym.envs  # noqa: E402
from nbc.evogym import EvoSim, EvoViewer, EvoWorld, WorldObject, utils  # noqa: E402
from nbc.evogym import get_full_connectivity, sample_robot  # noqa: E402
from nbc.evogym.envs.base import BenchmarkBase, EvoGymBase  # noqa: E402

BODY = np.array([[3, 3, 3], [4, 1, 4], [3, 0, 3]])


def _file(path, name, structure, at, grid=(40, 60)):
    """A world of the design tool with one object."""
    height, width = np.shape(structure)
    cells = {}
    for row, column in np.argwhere(np.asarray(structure) > 0).tolist():
        cells[(at[1] + height - 1 - row) * grid[0] + at[0] + column] = int(structure[row][column])
    beside = {n: [m for m in (n - 1, n + 1, n - grid[0], n + grid[0]) if m in cells] for n in cells}
    found = {"indices": list(cells), "types": list(cells.values()), "neighbors": {str(n): m for n, m in beside.items()}}
    path.write_text(json.dumps({"grid_width": grid[0], "grid_height": grid[1], "objects": {name: found}}))
    return str(path)


def test_a_random_robot_acts_until_it_is_done():
    """opendilab/DI-engine: dizoo/evogym/envs/test/gym_test.py"""
    body, connections = sample_robot((5, 5))
    env = gym.make("nbc/Walker-v0", body=body, connections=connections, max_episode_steps=20)
    env.reset()
    ends = 0
    for _ in range(45):
        _, _, terminated, truncated, _ = env.step(env.action_space.sample())
        env.render()
        if terminated or truncated:
            ends += 1
            env.reset()
    env.close()
    assert ends == 2


def test_a_camera_of_ones_own_replaces_that_of_the_environment():
    """opendilab/DI-engine: dizoo/evogym/envs/test/visualize_simple_env.py"""
    env = gym.make("nbc/Walker-v0", body=BODY, render_mode="rgb_array")

    class Camera(EvoViewer):
        def render(self, *arguments, **options):
            return super().render(*arguments, **options)[::-1]

    own = env.unwrapped
    before = own.render()
    own._default_viewer = Camera(EvoSim(own.world))
    own.default_viewer.track_objects("robot")
    np.testing.assert_array_equal(own.render()[::-1], before)


def test_a_loop_counts_its_env_steps():
    """Eshaancoding/ResearchProject: RobotBenchmark/EvoGymTest.py"""
    body, _ = sample_robot((5, 5))
    env = gym.make("nbc/Walker-v0", body=body)
    first, _ = env.reset()
    i = 0
    while True:
        observed, reward, terminated, truncated, _ = env.step(env.action_space.sample())
        assert np.shape(observed) == np.shape(first) and math.isfinite(reward)
        if terminated or truncated:
            env.reset()
        i += 1
        if i == 60:
            break
    env.close()


def test_the_best_robot_becomes_a_film(tmp_path):
    """MartaCRosa/evolving-soft-robots-EvoGym: utils.py and structure_GA.py"""
    image = pytest.importorskip("PIL.Image")

    def alternating(size, t):
        action = np.zeros(size)
        action[t % 2 :: 2] = 1.6
        return action

    def fitness(structure, frames=None):
        env = gym.make("nbc/Walker-v0", max_episode_steps=30, body=structure,
                       connections=get_full_connectivity(structure))
        env.reset()
        sim = env.unwrapped.sim
        viewer = EvoViewer(sim, resolution=(80, 40))
        viewer.track_objects("robot")
        total, size = 0, sim.get_dim_action_space("robot")
        for t in range(30):
            _, reward, terminated, truncated, _ = env.step(alternating(size, t))
            total += reward
            if frames is not None:
                frames.append(viewer.render("rgb_array"))
            if terminated or truncated:
                break
        viewer.close()
        env.close()
        return total

    random.seed(6363)
    population = [sample_robot((5, 5))[0] for _ in range(4)]
    best = max(population, key=fitness)
    frames = []
    assert fitness(best, frames) == max(map(fitness, population)) and len(frames) == 30
    nbc.evogym.save_gif(tmp_path / "best.gif", frames, fps=15)
    assert image.open(tmp_path / "best.gif").size == (80, 40)


@pytest.mark.parametrize("mode", ["none", "video"])
def test_a_phenotype_is_evaluated(mode):
    """mdb42/evogym-playground: src/simulation/evaluation.py"""
    body, connections = sample_robot((4, 4))
    env = gym.make("nbc/Walker-v0", body=body, connections=connections,
                   render_mode="rgb_array" if mode == "video" else None)
    env.metadata["render_fps"] = 30
    total, frames = 0, []
    observed, _ = env.reset()
    for _ in range(5):
        observed, reward, terminated, truncated, _ = env.step(np.full(env.action_space.shape, 1 + observed[0]))
        total += reward
        if mode == "video":
            frames.append(env.render())
        if terminated or truncated:
            break
    env.close()
    assert math.isfinite(total) and [frame.shape for frame in frames] == [(600, 1200, 3)] * len(frames)


def _displacement(task):
    structure, phases = task
    world = EvoWorld()
    world.add_from_array(name="robot", structure=structure, x=3, y=1, connections=get_full_connectivity(structure))
    sim = EvoSim(world)
    sim.reset()
    actuators = sim.get_actuator_indices("robot").astype(int).flatten()
    before = float(np.mean(sim.object_pos_at_time(sim.get_time(), "robot")[0]))
    for t in range(60):
        action = 1.0 + 0.4 * np.sin(2 * math.pi * t / 20 + phases.reshape(-1)[actuators])
        sim.set_action("robot", np.clip(action, 0.6, 1.6).astype(np.float64))
        if sim.step():
            break
    return float(np.mean(sim.object_pos_at_time(sim.get_time(), "robot")[0])) - before


def test_a_population_is_simulated_at_once():
    """karinemiras/evogym-GRN: simulation/simulation_resources.py"""
    choose = np.random.default_rng(1)
    tasks = [(sample_robot((5, 5))[0], choose.choice([0, math.pi], (5, 5))) for _ in range(4)]
    with ThreadPoolExecutor(max_workers=2) as executor:
        found = list(executor.map(_displacement, tasks))
    assert found == [_displacement(task) for task in tasks] and np.isfinite(found).all()


def test_many_robots_share_a_world():
    """karinemiras/evogym-GRN: simulation/test_multi_robot_limits.py"""
    world, names = EvoWorld(), [f"robot_{n}" for n in range(5)]
    choose = np.random.default_rng(11)
    for n, name in enumerate(names):
        body = choose.choice([1, 2, 3, 4], (6, 6)).astype(np.int32)
        world.add_from_array(name=name, structure=body, x=6 + 6 * n, y=3,
                             connections=get_full_connectivity(body).astype(np.int32))
    fixed = utils.VOXEL_TYPES["FIXED"]
    world.add_from_array("left_wall", np.full((10, 1), fixed), 1, 1)
    world.add_from_array("right_wall", np.full((10, 1), fixed), 41, 1)
    world.add_from_array("floor", np.full((1, 41), fixed), 1, 0)
    sim = EvoSim(world)
    sim.reset()
    viewer = EvoViewer(sim, resolution=(240, 120), pos=(12.0, 4.0), view_size=(40.0, 20.0))
    viewer.track_objects(*names)
    viewer.set_tracking_settings(padding=(4, 1), scale=(0.03, 0.0), lock_y=4, lock_height=12)
    for t in range(12):
        for name in names:
            phases = np.zeros(36)[sim.get_actuator_indices(name)]
            sim.set_action(name, np.clip(1 + 0.4 * np.sin(t / 4 + phases), 0.6, 1.6))
        assert not sim.step()
    assert viewer.render("img").shape == (120, 240, 3) and viewer.pos[1] == 4
    assert all(sim.object_pos_at_time(12, name).shape == (2, 49) for name in names)


def test_a_package_falls_between_pegs(tmp_path):
    """egedebruin/evogym-bayesian-optimization: util/world.py"""
    world = EvoWorld.from_json(_file(tmp_path / "ground.json", "ground", [[5] * 40], (0, 0)))
    package = _file(tmp_path / "package.json", "box", [[2, 2], [2, 2]], (0, 0))
    peg = _file(tmp_path / "peg.json", "peg", [[5], [5]], (0, 0))
    for name, file, at in (("package", package, (10, 21)), ("peg1", peg, (6, 19)), ("peg2", peg, (9, 12))):
        made = WorldObject.from_json(file)
        made.set_pos(*at)
        made.rename(name)
        world.add_object(made)
    world.add_from_array(name="robot", structure=BODY, x=16, y=1, connections=utils.get_full_connectivity(BODY))
    EvoSim._has_displayed_version = True
    sim = EvoSim(world)
    viewer = EvoViewer(sim)
    viewer.track_objects("package", "robot")
    sim.reset()
    start = sim.object_pos_at_time(sim.get_time(), "package")
    for step in range(20):
        if step % 5 == 0:
            sim.set_action("robot", np.full(7, 0.5) + 0.6)
        sim.step()
    assert np.mean(sim.object_pos_at_time(sim.get_time(), "package")[1]) < np.mean(start[1])


def test_sensors_are_the_corners_of_voxels():
    """egedebruin/evogym-bayesian-optimization: robot/sensors.py counts points in their order of creation."""
    world = EvoWorld()
    world.add_from_array("ground", np.full((1, 12), 5), 0, 0)
    world.add_from_array("robot", BODY, 4, 1)
    sim = EvoSim(world)
    positions, velocities = sim.object_pos_at_time(0, "robot"), sim.object_vel_at_time(0, "robot")
    numbers = {}
    for row, column in np.argwhere(BODY > 0).tolist():
        for down in (0, 1):
            for right in (0, 1):
                numbers.setdefault((row + down, column + right), len(numbers))
    assert positions.shape == velocities.shape == (2, len(numbers))
    for row, column in np.argwhere(BODY > 0).tolist():
        a, b, c, _ = (positions[:, numbers[row + down, column + right]] for down in (0, 1) for right in (0, 1))
        assert math.dist(a, b) * math.dist(a, c) == pytest.approx(1)
        assert a.tolist() == pytest.approx([4 + column, 4 - row])


def test_a_parkour_is_an_environment(tmp_path):
    """tsukuba-websci/POET-Evogym-LLM: custom_envs/parkour.py"""
    path = _file(tmp_path / "terrain.json", "terrain", [[0] * 20 + [5] * 20, [5] * 40], (0, 6))

    class Parkour(BenchmarkBase):
        def __init__(self, body, connections, terrain):
            self.world = EvoWorld()
            size = utils.Pair(terrain["grid_width"], terrain["grid_height"])
            for name, data in terrain["objects"].items():
                made = WorldObject()
                made.load_from_parsed_json(name, data, size)
                self.world.add_object(made)
            self.world.add_from_array("robot", body, 1, 8, connections=connections)
            BenchmarkBase.__init__(self, self.world)
            self.terrain_list, self.sight_dist = list(terrain["objects"]), 10
            count = self.object_pos_at_time(self.get_time(), "robot").size
            self.action_space = gym.spaces.Box(0.6, 1.6, (self.get_actuator_indices("robot").size,), float)
            self.observation_space = gym.spaces.Box(-100.0, 100.0, (3 + count + 21,), float)

        def _seen(self):
            return np.concatenate((
                self.get_vel_com_obs("robot"), self.get_ort_obs("robot"), self.get_relative_pos_obs("robot"),
                self.get_floor_obs("robot", self.terrain_list, self.sight_dist),
            ))

        def step(self, action):
            before = np.mean(self.object_pos_at_time(self.get_time(), "robot"), axis=1)
            done = super().step({"robot": action})
            after = np.mean(self.object_pos_at_time(self.get_time(), "robot"), axis=1)
            done = done or after[1] < 5 * self.VOXEL_SIZE or after[0] > self.world.grid_size.x * self.VOXEL_SIZE
            return self._seen(), after[0] - before[0], bool(done), False, {}

        def reset(self, seed=None, options=None):
            super().reset(seed=seed)
            return self._seen(), {}

    env = Parkour(BODY, get_full_connectivity(BODY), json.loads((tmp_path / "terrain.json").read_text()))
    assert path and env.observation_space.contains(env.reset()[0])
    for _ in range(20):
        observed, reward, done, _, _ = env.step(env.action_space.sample())
        assert env.observation_space.contains(observed) and math.isfinite(reward) and not done


def test_a_body_is_read_from_a_table_and_stepped_as_a_vector(tmp_path):
    """hosoda723/share_evogym: envs/evogym/gym_utils.py"""
    np.savetxt(tmp_path / "robot.txt", BODY)
    body = np.loadtxt(tmp_path / "robot.txt")
    assert nbc.evogym.is_connected(body) and nbc.evogym.has_actuator(body)

    def make(seed):
        def make_one():
            env = gym.make("nbc/UpStepper-v0", body=body, connections=get_full_connectivity(body))
            env = gym.wrappers.RescaleAction(env, -1.0, 1.0)
            env.reset(seed=seed)
            return gym.wrappers.RecordEpisodeStatistics(env)
        return make_one

    many = gym.wrappers.vector.NormalizeObservation(gym.vector.SyncVectorEnv([make(seed) for seed in range(2)]))
    many.reset(seed=1)
    for _ in range(3):
        observed, rewards, *_ = many.step(many.action_space.sample())
    assert observed.shape[0] == 2 and np.isfinite(observed).all() and np.isfinite(rewards).all()
    many.close()


def test_a_jumper_counts_in_voxels():
    """An environment on `EvoGymBase` whose `step` makes several env steps and whose camera is its own."""
    world = EvoWorld()
    world.add_from_array("ground", np.full((1, 30), 5), 0, 0)
    world.add_from_array("robot", BODY, 4, 1)

    class Jumper(EvoGymBase):
        metadata = {"render_modes": ["human", "img"]}

        def __init__(self, world, render_mode=None):
            super().__init__(world=world, render_mode=render_mode)
            self.action_space = gym.spaces.Box(-1.0, 1.0, (len(self.get_actuator_indices("robot")),), np.float32)

        def reset(self, *, seed=None, options=None):
            super().reset(seed=seed)
            self.ground = self.get_pos_com_obs("robot")[1]
            return self.get_vel_com_obs("robot"), {}

        def step(self, action):
            for _ in range(3):
                super().step({"robot": np.clip(1.0 + np.clip(action, -1.0, 1.0), 0.0, 2.0)})
            height = self.get_pos_com_obs("robot")[1] - self.ground
            return self.get_vel_com_obs("robot"), height, False, self.get_time() >= 30, {}

        def render(self):
            if not hasattr(self, "viewer"):
                self.viewer = EvoViewer(self.sim, target_rps=None, view_size=(16, 6), resolution=(102, 51))
                self.viewer.track_objects("robot")
            return self.viewer.render("img", hide_grid=True) if self.render_mode == "img" else None

    env = Jumper(world, render_mode="img")
    env.reset(seed=1)
    rises = [env.step(np.full(7, sign, dtype=np.float32))[1] for sign in (1, 1, -1)]
    assert rises[1] > rises[0] > 0 and env.render().shape == (51, 102, 3)

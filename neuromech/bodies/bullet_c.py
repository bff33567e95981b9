"""Bullet through its C functions, which the extension module of PyBullet exports.

Sources: signatures, status numbers and the layout of answers are those of bullet3 3.27, examples/SharedMemory/
PhysicsClientC_API.h and SharedMemoryPublic.h (https://github.com/bulletphysics/bullet3).
"""

from collections.abc import Mapping, Sequence
from ctypes import CDLL, Structure, byref, c_char, c_char_p, c_double, c_int, c_void_p, cast, sizeof
from functools import cache
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Final

from neuromech.bodies.bullet_client import BulletBox, BulletClient, BulletError, BulletJoint

_VERSION: Final = "3.2.7"
_URDF_LOADED: Final = 6
_INERTIA_FROM_FILE: Final = 2
_VELOCITY_CONTROL: Final = 0
_FIXED: Final = 4

_P, _I, _D, _S = c_void_p, c_int, c_double, c_char_p
_SIGNATURES: Final[dict[str, tuple[Any, ...]]] = {
    "b3ConnectPhysicsDirect": (_P,),
    "b3DisconnectSharedMemory": (None, _P),
    "b3SubmitClientCommandAndWaitStatus": (_P, _P, _P),
    "b3SubmitClientCommand": (_I, _P, _P),
    "b3ProcessServerStatus": (_P, _P),
    "b3GetStatusType": (_I, _P),
    "b3GetStatusBodyIndex": (_I, _P),
    "b3GetStatusCollisionShapeUniqueId": (_I, _P),
    "b3GetStatusActualState2": (_I, *[_P] * 13),
    "b3InitPhysicsParamCommand": (_P, _P),
    "b3PhysicsParamSetEnableFileCaching": (_I, _P, _I),
    "b3PhysicsParamSetTimeStep": (_I, _P, _D),
    "b3PhysicsParamSetNumSubSteps": (_I, _P, _I),
    "b3PhysicsParamSetNumSolverIterations": (_I, _P, _I),
    "b3PhysicsParameterSetDeterministicOverlappingPairs": (_I, _P, _I),
    "b3PhysicsParamSetGravity": (_I, _P, _D, _D, _D),
    "b3LoadUrdfCommandInit": (_P, _P, _S),
    "b3LoadUrdfCommandSetFlags": (_I, _P, _I),
    "b3LoadUrdfCommandSetUseFixedBase": (_I, _P, _I),
    "b3GetNumJoints": (_I, _P, _I),
    "b3GetJointInfo": (_I, _P, _I, _I, _P),
    "b3CreateCollisionShapeCommandInit": (_P, _P),
    "b3CreateCollisionShapeAddPlane": (_I, _P, _P, _D),
    "b3CreateCollisionShapeAddSphere": (_I, _P, _D),
    "b3CollisionFilterCommandInit": (_P, _P),
    "b3SetCollisionFilterGroupMask": (_I, _P, _I, _I, _I, _I),
    "b3CreateCollisionShapeAddBox": (_I, _P, _P),
    "b3CreateCollisionShapeSetChildTransform": (None, _P, _I, _P, _P),
    "b3CreateMultiBodyCommandInit": (_P, _P),
    "b3CreateMultiBodyBase": (_I, _P, _D, _I, _I, _P, _P, _P, _P),
    "b3JointControlCommandInit2": (_P, _P, _I, _I),
    "b3JointControlSetDesiredVelocity": (_I, _P, _I, _D),
    "b3JointControlSetKd": (_I, _P, _I, _D),
    "b3JointControlSetMaximumForce": (_I, _P, _I, _D),
    "b3JointControlSetDesiredForceTorque": (_I, _P, _I, _D),
    "b3InitChangeDynamicsInfo": (_P, _P),
    "b3ChangeDynamicsInfoSetLinearDamping": (_I, _P, _I, _D),
    "b3ChangeDynamicsInfoSetAngularDamping": (_I, _P, _I, _D),
    "b3ChangeDynamicsInfoSetMaxJointVelocity": (_I, _P, _I, _D),
    "b3ChangeDynamicsInfoSetJointDamping": (_I, _P, _I, _I, _D),
    "b3ChangeDynamicsInfoSetRestitution": (_I, _P, _I, _I, _D),
    "b3ChangeDynamicsInfoSetLateralFriction": (_I, _P, _I, _I, _D),
    "b3ChangeDynamicsInfoSetRollingFriction": (_I, _P, _I, _I, _D),
    "b3ChangeDynamicsInfoSetSpinningFriction": (_I, _P, _I, _I, _D),
    "b3ChangeDynamicsInfoSetContactStiffnessAndDamping": (_I, _P, _I, _I, _D, _D),
    "b3GetDynamicsInfoCommandInit": (_P, _P, _I, _I),
    "b3GetDynamicsInfo": (_I, _P, _P),
    "b3CreatePoseCommandInit": (_P, _P, _I),
    "b3CreatePoseCommandSetBasePosition": (_I, _P, _D, _D, _D),
    "b3CreatePoseCommandSetBaseOrientation": (_I, _P, _D, _D, _D, _D),
    "b3CreatePoseCommandSetBaseLinearVelocity": (_I, _P, _P),
    "b3CreatePoseCommandSetBaseAngularVelocity": (_I, _P, _P),
    "b3CreatePoseCommandSetJointPosition": (_I, _P, _P, _I, _D),
    "b3CreatePoseCommandSetJointVelocity": (_I, _P, _P, _I, _D),
    "b3ApplyExternalForceCommandInit": (_P, _P),
    "b3ApplyExternalForce": (None, _P, _I, _I, _P, _P, _I),
    "b3RequestActualStateCommandInit": (_P, _P, _I),
    "b3InitRequestContactPointInformation": (_P, _P),
    "b3SetContactFilterBodyA": (None, _P, _I),
    "b3SetContactFilterBodyB": (None, _P, _I),
    "b3GetContactPointInformation": (None, _P, _P),
    "b3InitStepSimulationCommand": (_P, _P),
}
_OF_ROBOT: Final = {
    "linearDamping": "b3ChangeDynamicsInfoSetLinearDamping",
    "angularDamping": "b3ChangeDynamicsInfoSetAngularDamping",
    "maxJointVelocity": "b3ChangeDynamicsInfoSetMaxJointVelocity",
}
_OF_LINK: Final = {
    "jointDamping": "b3ChangeDynamicsInfoSetJointDamping",
    "restitution": "b3ChangeDynamicsInfoSetRestitution",
    "lateralFriction": "b3ChangeDynamicsInfoSetLateralFriction",
    "rollingFriction": "b3ChangeDynamicsInfoSetRollingFriction",
    "spinningFriction": "b3ChangeDynamicsInfoSetSpinningFriction",
}


class _JointInfo(Structure):
    _fields_ = (
        ("link", c_char * 1024),
        ("joint", c_char * 1024),
        ("kind", c_int),
        ("position", c_int),
        ("velocity", c_int),
        ("number", c_int),
        ("rest", c_char * 1024),
    )


class _DynamicsInfo(Structure):
    _fields_ = (("mass", c_double), ("inertia", c_double * 3), ("rest", c_char * 1024))


@cache
def bullet_library() -> CDLL | None:
    """Return Bullet's C functions, or None where this PyBullet has other ones or does not export them."""
    spec = find_spec("pybullet")
    if spec is None or spec.origin is None or version("pybullet") != _VERSION or sizeof(c_void_p) != 8:
        return None
    try:
        library = CDLL(spec.origin)
        for name, (result, *arguments) in _SIGNATURES.items():
            function = getattr(library, name)
            function.restype, function.argtypes = result, arguments
    except (OSError, AttributeError):
        return None
    return library


class CClient(BulletClient):
    """A direct client made by Bullet's C functions.

    Attributes:
        handle: Bullet's pointer to the client, 0 when closed.
    """

    def __init__(self, library: CDLL) -> None:
        """Connect."""
        self._b3 = library
        self.handle: int = library.b3ConnectPhysicsDirect()

    def set_engine(self, step: float, iterations: int, gravity: float) -> None:
        """Set time step, iterations and gravity."""
        command = self._b3.b3InitPhysicsParamCommand(self.handle)
        self._b3.b3PhysicsParamSetNumSolverIterations(command, iterations)
        self._b3.b3PhysicsParamSetNumSubSteps(command, 0)
        self._b3.b3PhysicsParamSetTimeStep(command, step)
        self._b3.b3PhysicsParameterSetDeterministicOverlappingPairs(command, 1)
        self._submit(command)
        command = self._b3.b3InitPhysicsParamCommand(self.handle)
        self._b3.b3PhysicsParamSetGravity(command, 0.0, 0.0, -gravity)
        self._submit(command)

    def load(self, file: Path, fixed: bool) -> int:
        """Load a URDF file."""
        # Bullet keeps files by name; another body's file may have had this one.
        command = self._b3.b3InitPhysicsParamCommand(self.handle)
        self._b3.b3PhysicsParamSetEnableFileCaching(command, 0)
        self._submit(command)
        command = self._b3.b3LoadUrdfCommandInit(self.handle, str(file).encode())
        self._b3.b3LoadUrdfCommandSetFlags(command, _INERTIA_FROM_FILE)
        if fixed:
            self._b3.b3LoadUrdfCommandSetUseFixedBase(command, 1)
        status = self._submit(command)
        if self._b3.b3GetStatusType(status) != _URDF_LOADED:
            raise BulletError("Cannot load URDF file.")
        return int(self._b3.b3GetStatusBodyIndex(status))

    def joints(self, robot: int) -> list[BulletJoint]:
        """Return the joints of a robot."""
        return [self._joint(robot, number) for number in range(self._b3.b3GetNumJoints(self.handle, robot))]

    def add_plane(self, height: float) -> int:
        """Add a level plane."""
        command = self._b3.b3CreateCollisionShapeCommandInit(self.handle)
        self._b3.b3CreateCollisionShapeAddPlane(command, _numbers(0.0, 0.0, 1.0), 0.0)
        return self._add(command, (0.0, 0.0, height))

    def add_boxes(self, boxes: Sequence[BulletBox]) -> int:
        """Add boxes as one thing."""
        command = self._b3.b3CreateCollisionShapeCommandInit(self.handle)
        for box in boxes:
            number = self._b3.b3CreateCollisionShapeAddBox(command, _numbers(*(0.5 * side for side in box.size)))
            place, turned = _numbers(*box.position), _numbers(*box.quaternion)
            self._b3.b3CreateCollisionShapeSetChildTransform(command, number, place, turned)
        return self._add(command, (0.0, 0.0, 0.0))

    def add_ball(self, radius: float, mass: float, position: Sequence[float]) -> int:
        """Add a ball."""
        command = self._b3.b3CreateCollisionShapeCommandInit(self.handle)
        self._b3.b3CreateCollisionShapeAddSphere(command, radius)
        return self._add(command, position, mass)

    def set_partners(self, thing: int, link: int, group: int, partners: int) -> None:
        """Say with what a link collides."""
        command = self._b3.b3CollisionFilterCommandInit(self.handle)
        self._b3.b3SetCollisionFilterGroupMask(command, thing, link, group, partners)
        self._submit(command)

    def stop_motors(self, robot: int, joints: Sequence[BulletJoint]) -> None:
        """Take away the force of the motors."""
        command = self._b3.b3JointControlCommandInit2(self.handle, robot, _VELOCITY_CONTROL)
        for joint in joints:
            self._b3.b3JointControlSetDesiredVelocity(command, joint.velocity, 0.0)
            self._b3.b3JointControlSetKd(command, joint.velocity, 1.0)
            self._b3.b3JointControlSetMaximumForce(command, joint.velocity, 0.0)
        self._submit(command)

    def set_dynamics(self, robot: int, link: int, settings: Mapping[str, float]) -> None:
        """Set properties of a link."""
        command = self._b3.b3InitChangeDynamicsInfo(self.handle)
        for name in settings.keys() & _OF_ROBOT.keys():
            getattr(self._b3, _OF_ROBOT[name])(command, robot, settings[name])
        for name in settings.keys() & _OF_LINK.keys():
            getattr(self._b3, _OF_LINK[name])(command, robot, link, settings[name])
        if "contactStiffness" in settings:
            self._b3.b3ChangeDynamicsInfoSetContactStiffnessAndDamping(
                command, robot, link, settings["contactStiffness"], settings["contactDamping"]
            )
        self._submit(command)

    def inertia(self, robot: int, link: int) -> tuple[float, float, float, float]:
        """Return mass and principal moments of inertia of a link."""
        info = _DynamicsInfo()
        status = self._submit(self._b3.b3GetDynamicsInfoCommandInit(self.handle, robot, link))
        self._b3.b3GetDynamicsInfo(status, byref(info))
        x, y, z = info.inertia
        return (info.mass, x, y, z)

    def put_root(
        self, robot: int, position: Sequence[float], quaternion: Sequence[float], velocity: Sequence[float]
    ) -> None:
        """Put the root link's centre of mass to a place."""
        command = self._b3.b3CreatePoseCommandInit(self.handle, robot)
        self._b3.b3CreatePoseCommandSetBasePosition(command, *position)
        self._b3.b3CreatePoseCommandSetBaseOrientation(command, *quaternion)
        self._b3.b3CreatePoseCommandSetBaseLinearVelocity(command, _numbers(*velocity))
        self._b3.b3CreatePoseCommandSetBaseAngularVelocity(command, _numbers(0.0, 0.0, 0.0))
        self._submit(command)

    def put_joint(self, robot: int, joint: int, position: float, velocity: float) -> None:
        """Give a joint its angle and velocity."""
        command = self._b3.b3CreatePoseCommandInit(self.handle, robot)
        self._b3.b3CreatePoseCommandSetJointPosition(self.handle, command, joint, position)
        self._b3.b3CreatePoseCommandSetJointVelocity(self.handle, command, joint, velocity)
        self._submit(command)

    def address(self, name: str) -> int:
        """Return where one of Bullet's C functions stands in memory."""
        return cast(getattr(self._b3, name), c_void_p).value or 0

    def close(self) -> None:
        """Disconnect."""
        if self.handle:
            self._b3.b3DisconnectSharedMemory(self.handle)
            self.handle = 0

    def _add(self, shape: int, position: Sequence[float], mass: float = 0.0) -> int:
        number = self._b3.b3GetStatusCollisionShapeUniqueId(self._submit(shape))
        command = self._b3.b3CreateMultiBodyCommandInit(self.handle)
        nowhere, level = _numbers(0.0, 0.0, 0.0), _numbers(0.0, 0.0, 0.0, 1.0)
        self._b3.b3CreateMultiBodyBase(command, mass, number, -1, _numbers(*position), level, nowhere, level)
        return int(self._b3.b3GetStatusBodyIndex(self._submit(command)))

    def _submit(self, command: int) -> int:
        status: int | None = self._b3.b3SubmitClientCommandAndWaitStatus(self.handle, command)
        if status is None:
            raise BulletError("Bullet did not answer.")
        return status

    def _joint(self, robot: int, number: int) -> BulletJoint:
        info = _JointInfo()
        self._b3.b3GetJointInfo(self.handle, robot, number, byref(info))
        return BulletJoint(
            info.number, info.joint.decode(), info.link.decode(), info.kind != _FIXED, info.position, info.velocity
        )


def _numbers(*values: float) -> Any:
    return (c_double * len(values))(*values)

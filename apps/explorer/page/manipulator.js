// The table [manipulator] of a problem: its joints, and what moving one of them makes of it.
//
// A manipulator in the thesis's form, design = [x_C, y_C, x_D, x_E, r], keeps it: its base joints stay in line, and its
// platform joints at -r, -r and r.

/** The three coordinates of the thesis's form that are of base joints 1 to 3. */
const baseColumn = [0, 2, 3];

const turned = ([x, y], degrees) => {
  const angle = (degrees * Math.PI) / 180;
  return [Math.cos(angle) * x - Math.sin(angle) * y, Math.sin(angle) * x + Math.cos(angle) * y];
};

/** The legs, whatever form the manipulator is given in. */
export function legsOf(manipulator) {
  if (!manipulator.design) return manipulator.leg;
  const [xC, yC, xD, xE, r] = manipulator.design;
  return [xC, xD, xE].map((x, k) => ({ base: [x, yC], platform: [k < 2 ? -r : r, 0], length: manipulator.length[k] }));
}

/** A platform joint in the plane. */
export function platformJoint(leg, pose) {
  const [x, y] = turned(leg.platform, pose.phi);
  return [pose.x + x, pose.y + y];
}

/** The same manipulator with another length limit of a leg: end 0 is the least, 1 the greatest length. */
export function withLength(manipulator, index, end, value) {
  const changed = (pair) => pair.map((old, k) => (k === end ? value : old));
  if (manipulator.design) {
    return { ...manipulator, length: manipulator.length.map((pair, k) => (k === index ? changed(pair) : pair)) };
  }
  return withLeg(manipulator, index, { length: changed(manipulator.leg[index].length) });
}

/** The same with a base joint elsewhere. */
export function withBase(manipulator, index, [x, y]) {
  if (!manipulator.design) return withLeg(manipulator, index, { base: [x, y] });
  const design = [...manipulator.design];
  design[baseColumn[index]] = x;
  design[1] = y;
  return { ...manipulator, design };
}

/** The same with a platform joint that is seen at a point of the plane. */
export function withPlatform(manipulator, index, [x, y], pose) {
  const [along, across] = turned([x - pose.x, y - pose.y], -pose.phi);
  if (!manipulator.design) return withLeg(manipulator, index, { platform: [along, across] });
  const design = [...manipulator.design];
  design[4] = index < 2 ? -along : along;
  return { ...manipulator, design };
}

/** The same with the coordinates of every joint given by themselves. L stays what it was. */
export function withFreeJoints(manipulator, characteristicLength) {
  const { design, length, leg, ...rest } = manipulator;
  return { characteristic_length: characteristicLength, ...rest, leg: legsOf(manipulator) };
}

function withLeg(manipulator, index, part) {
  return { ...manipulator, leg: manipulator.leg.map((leg, k) => (k === index ? { ...leg, ...part } : leg)) };
}

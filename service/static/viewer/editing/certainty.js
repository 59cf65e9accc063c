// How certain the method is of a cut: from 0 to 1, and null where a person has placed it.

const DOUBT = 0.5;

/** Whether the cut that ends a segment is rather wrong than right. The last segment ends with the take, for certain. */
export const doubtful = ({ confidence }) => confidence !== null && confidence < DOUBT;
